# SPDX-License-Identifier: Apache-2.0
"""What every test has in common: the seed in the header, and how to run a failed test again."""

from collections.abc import Generator

import pytest

from tb.runner import FULL, SEED, WAVES


def pytest_report_header() -> str:
    """The seed of the run."""
    return f"seed: {SEED} (choose one with SEED=...), {'all tests' if FULL else 'more with FULL=1'}"


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out what only ``make test-all`` runs, unless it is asked for by its name."""
    named = any("::" in argument for argument in config.args)
    left_out = [item for item in items if not FULL and not named and item.get_closest_marker("full")]
    if left_out:
        config.hook.pytest_deselected(items=left_out)
        items[:] = [item for item in items if item not in left_out]


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
