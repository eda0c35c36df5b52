"""What every test has in common: the seed in the header, and how to run a failed test again."""

from collections.abc import Generator

import pytest

from tb.runner import SEED, WAVES


def pytest_report_header() -> str:
    """The seed of the run."""
    return f"seed: {SEED} (choose one with SEED=...)"


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Add the line to paste to the report of a test that failed."""
    report = yield
    if report.failed:
        report.sections.append(("run it again", f"make test-one T='{item.nodeid}' SEED={SEED} WAVES=1"))
    return report


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Tell where the waveforms are, of tests that passed as well."""
    if WAVES:
        reports = terminalreporter.getreports("passed") + terminalreporter.getreports("failed")
        for report in reports:
            for line in report.capstdout.splitlines():
                if line.startswith("waveform: "):
                    terminalreporter.write_line(line)
