"""A frame's parts by hand-computed numbers; injected faults are found, whatever they are."""

from __future__ import annotations

import itertools
from types import SimpleNamespace

import numpy as np
import pytest

import sim
from golden import contract as k
from golden import plan, poly
from golden.reference import light
from sim import frame
from sim.errors import UserError
from sim.scene.camera import Camera
from sim.scene.raster import Spans
from tb.runner import SEED

ONE = 1 << k.INTENSITY_F


# ---- numbers -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("intensity", "expected"),
    [
        (0.0, 0), (1.0, 65536), (-1.0, -65536), (0.5, 32768), (1 / 3, 21845), (2 / 3, 43691),
        (1.5 / 65536, 2), (2.5 / 65536, 2), (-1.5 / 65536, -2), (0.49 / 65536, 0),  # to nearest
        (1.9999999, 131071), (2.0, 131071), (1e300, 131071), (-2.0, -131072), (-2.1, -131072), (float("-inf"), -131072),
    ],
)  # fmt: skip
def test_quantize(intensity: float, expected: int) -> None:
    assert frame.quantize(np.array(intensity)) == expected


def test_errors() -> None:
    """NMSE, PSNR and largest error of two visible pixels, computed by hand; hidden ones do not count."""
    exact = np.array([[0.5, 0.0], [9.0, 9.0], [1.0, 0.25]])
    intensity = exact + np.array([[0.1, 0.0], [5.0, 5.0], [-0.2, 0.05]])
    visible = np.array([-1, 2, -1, 0])
    told = frame.errors(intensity, exact, visible)
    assert told["nmse_diffuse"] == pytest.approx((0.01 + 0.04) / (0.25 + 1))
    assert told["nmse_specular"] == pytest.approx(0.0025 / 0.0625)
    assert told["nmse"] == pytest.approx(0.0525 / 1.3125)
    assert told["max_error"] == pytest.approx(0.2)
    assert told["psnr_db"] == pytest.approx(-10 * np.log10(0.0525 / 4))
    assert all(type(value) is float for value in told.values())


@pytest.mark.parametrize(
    ("intensity", "visible", "expected"),
    [
        ([], [-1, -1], {"nmse": None, "nmse_diffuse": None, "nmse_specular": None, "psnr_db": None, "max_error": 0.0}),
        # without light a ratio has no value; without an error a PSNR has none
        ([[0, 0]], [0], {"nmse": None, "nmse_diffuse": None, "nmse_specular": None, "psnr_db": None, "max_error": 0.0}),
        ([[0.5, 0]], [0], {"nmse": 0.0, "nmse_diffuse": 0.0, "nmse_specular": None, "psnr_db": None, "max_error": 0.0}),
    ],
)
def test_errors_of_nothing(intensity: list, visible: list[int], expected: dict) -> None:
    exact = np.array(intensity, float).reshape(-1, 2)
    assert frame.errors(exact, exact, np.array(visible)) == expected


def test_pictures() -> None:
    """Colours by hand: background where nothing is, three kinds of light on skin, 256 times the error."""
    visible = np.array([-1, 0, 1, 2])
    intensity = np.array([[0.0, 0.0], [0.5, 0.0], [1.0, 1.0]])
    exact = intensity + np.array([[0.0, 0.0], [1 / 512, -1 / 1024], [-1.0, 0.0]])
    shown = frame.Frame(visible, intensity, exact, {}, 2)

    def levels(colour: list[float]) -> list[int]:
        return [round(255 * min(part, 1)) for part in colour]

    skin = frame.SKIN
    picture = np.array(shown.picture(intensity))
    assert picture.shape == (2, 2, 3)
    assert picture[0, 0].tolist() == levels(frame.BACKGROUND)
    assert picture[0, 1].tolist() == levels(frame.AMBIENT * skin)
    assert picture[1, 0].tolist() == levels((frame.AMBIENT + 0.5 * frame.DIFFUSE) * skin)
    assert picture[1, 1].tolist() == levels((frame.AMBIENT + frame.DIFFUSE) * skin + frame.SPECULAR)
    # specular in red, diffuse in green: 256/1024, 256/512, clipped at 1
    assert np.array(shown.difference()).reshape(-1, 3).tolist() == [[0, 0, 0], [0, 0, 0], [64, 128, 0], [0, 255, 0]]


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"form": "Refined"}, "--form: 'Refined' is none of paper, refined"),
        ({"evaluator": ""}, "--evaluator: '' is none of horner, fdiff"),
        ({"model": "toon"}, "--model: 'toon' is none of blinn, phong, lambert"),
        ({"shininess": 0.5}, "--shininess: 0.5 is out of range, allowed is 1.0 to 1024.0"),
        ({"shininess": float("nan")}, "--shininess: nan is out of range"),
        ({"degree": 4}, "--degree: 4 is out of range, allowed is 1 to 3"),
        ({"light": (0.0, 0.0, 0.0)}, "--light: (0.0, 0.0, 0.0) is no direction"),
        ({"light": (1e308, 1e308, 0.0)}, "is no direction"),
        ({"light": (1.0, float("nan"), 0.0)}, "is no direction"),
    ],
)
def test_settings(options: dict, told: str) -> None:
    with pytest.raises(UserError) as error:
        frame.Settings(**options)
    assert str(error.value).startswith("--")
    assert told in str(error.value)


# ---- light at the nodes ------------------------------------------------------------------------------------------


def flat_spans(*counts: int) -> Spans:
    """Spans whose normal turns from the viewer to the right, by 1/100 a pixel."""
    spans = len(counts)
    zero, towards, turn = np.zeros(spans), np.array([[0.0, 0, 1]] * spans), np.array([[0.01, 0, 0]] * spans)
    line = np.arange(spans, dtype=np.int32)
    return Spans(line, line, line * 0, np.array(counts, np.int32), towards, turn, zero, zero)


def test_light_at_the_nodes() -> None:
    """Each record gets the light of its own nodes, quantized; what two records share is computed once."""
    spans = flat_spans(33, 3, 20)
    settings = frame.Settings(shininess=32)
    records = plan.plan(spans.count, [2 << plan.KAPPA_F, 0, 2 << plan.KAPPA_F])
    nodes, evaluations = frame.node_light(spans, records, settings)
    assert nodes.shape == (len(records), k.CHANNELS, k.NODE_COUNT)
    for record in range(len(records)):
        for node, pixel in enumerate(records.nodes[record]):
            normal = [0.01 * pixel, 0, 1]
            for channel, value in enumerate(light.light_channels("blinn", normal, settings.light, 32)):
                assert nodes[record, channel, node] == round(value * ONE)
    used = {(s, n) for s, row in zip(records.span, records.nodes, strict=True) for n in row}
    assert evaluations == len(used)
    assert evaluations < sum(len(set(row)) for row in records.nodes)  # neighbours share


def test_planned_as_in_the_paper() -> None:
    """Form paper: a record a span, of the degree asked for; up to 4 pixels are lit directly."""
    records = frame.plan_spans(flat_spans(33, 3, 20), frame.Settings(form="paper", degree=2))
    assert records.span.tolist() == [0, 1, 2]
    assert records.count.tolist() == [33, 3, 20]
    assert records.degree.tolist() == [2, 0, 2]
    assert records.nodes[0].tolist() == [0, 16, 32, 0]


def test_planned_by_kappa() -> None:
    """Form refined: kappa is that of the arc of 2^k pixels on which the span lies."""
    spans = flat_spans(33)
    end = np.array([0.32, 0, 1]) / np.hypot(0.32, 1)
    kappa = 32 * (1 - end[2])
    expected = plan.plan([33], [round(kappa * (1 << plan.KAPPA_F))])
    records = frame.plan_spans(spans, frame.Settings(shininess=32.0))
    for name in ("span", "start", "count", "degree", "log2"):
        assert np.array_equal(getattr(records, name), getattr(expected, name)), name
    assert len(records) > len(frame.plan_spans(spans, frame.Settings(shininess=1.0)))
    assert len(records) < len(frame.plan_spans(spans, frame.Settings(model="phong", shininess=32.0)))


# ---- faults ------------------------------------------------------------------------------------------------------


@pytest.fixture
def drawn() -> SimpleNamespace:
    """Three spans of 3, 1 and 4 pixels: what goes into the RTL, what must come out, and what comes out."""
    rng = np.random.default_rng(SEED)
    nodes = rng.integers(0, ONE, (3, k.CHANNELS, k.NODE_COUNT))
    degree, count, tag = np.array([1, 0, 2]), np.array([3, 1, 4]), np.array([7, 65535, 0])
    golden, owner = poly.poly_span(nodes, degree, count)
    outputs = {
        "m_axis_pixel_tdata": golden[:, 0] | golden[:, 1] << k.PIXEL_W,
        "m_axis_pixel_tuser": tag[owner],
        "m_axis_pixel_tlast": np.array([0, 0, 1, 1, 0, 0, 0, 1]),
    }
    beats = poly.pack_spans(nodes, degree, count, tag)
    return SimpleNamespace(outputs=outputs, expected=(beats, golden, tag, owner), golden=golden, beats=beats)


def compare(outputs: dict[str, np.ndarray], expected: tuple) -> tuple[np.ndarray, dict]:
    return frame._compare(sim.Run(outputs, [], [], 0, 0, {}), *expected)


def test_equal_frames(drawn: SimpleNamespace) -> None:
    """The RTL itself gives what the fixture says, and nothing is found in it."""
    pixels, told = compare(drawn.outputs, drawn.expected)
    assert told == {"mismatches": 0}
    assert np.array_equal(pixels, drawn.golden)
    model = sim.load("shade_poly_span", EVALUATOR=k.EVALUATOR_HORNER, FORM=k.FORM_REFINED)
    run = model.run(s_axis_span_tdata=drawn.beats)
    for name, value in drawn.outputs.items():
        assert np.array_equal(run.outputs[name], value), name


@pytest.mark.parametrize("at", range(8))
@pytest.mark.parametrize(
    ("name", "flip", "shift"),
    [
        *(("m_axis_pixel_tdata", bit, 0) for bit in (1, 1 << 15, 1 << 16, 1 << 31)),
        ("m_axis_pixel_tuser", 1, 32),
        ("m_axis_pixel_tuser", 1 << 15, 32),
        ("m_axis_pixel_tlast", 1, 48),
    ],
)
def test_one_wrong_bit(drawn: SimpleNamespace, at: int, name: str, flip: int, shift: int) -> None:
    """In any pixel, in value, tag or end of span: one mismatch, with its place, input and both outputs."""
    drawn.outputs[name][at] ^= flip
    pixels, told = compare(drawn.outputs, drawn.expected)
    assert told["mismatches"] == 1
    first = told["first_mismatch"]
    record = [0, 0, 0, 1, 2, 2, 2, 2][at]
    assert (first["pixel"], first["record"]) == (at, record)
    assert int(first["expected"], 16) ^ int(first["actual"], 16) == flip << shift
    assert int(first["input"], 16) == sum(int(word) << 32 * i for i, word in enumerate(drawn.beats[record]))
    changed = flip if shift == 0 else 0
    assert pixels[at].tolist() == (drawn.golden[at] ^ [changed & 0xFFFF, changed >> 16]).tolist()  # what is shown


@pytest.mark.parametrize(("at", "mismatches"), [(7, 1), (0, 8), (3, 5)])
def test_a_missing_pixel(drawn: SimpleNamespace, at: int, mismatches: int) -> None:
    """All behind it are at the wrong place."""
    outputs = {name: np.delete(value, at) for name, value in drawn.outputs.items()}
    pixels, told = compare(outputs, drawn.expected)
    assert told["mismatches"] == mismatches
    assert told["first_mismatch"]["pixel"] == at
    assert (told["first_mismatch"]["actual"] == "none") == (at == 7)
    assert pixels.shape == (8, 2)
    assert pixels[7].tolist() == [0, 0]


@pytest.mark.parametrize("extra", [1, 5])
def test_extra_pixels(drawn: SimpleNamespace, extra: int) -> None:
    outputs = {name: np.append(value, value[:extra]) for name, value in drawn.outputs.items()}
    pixels, told = compare(outputs, drawn.expected)
    assert told["mismatches"] == extra
    first = told["first_mismatch"]
    assert (first["pixel"], first["record"], first["input"], first["expected"]) == (8, -1, "none", "none")
    assert int(first["actual"], 16) & 0xFFFFFFFF == drawn.outputs["m_axis_pixel_tdata"][0]
    assert np.array_equal(pixels, drawn.golden)


def test_no_pixels_at_all(drawn: SimpleNamespace) -> None:
    outputs = {name: value[:0] for name, value in drawn.outputs.items()}
    assert compare(outputs, drawn.expected)[1]["mismatches"] == 8
    beats, golden, tag, owner = drawn.expected
    assert compare(outputs, (beats[:0], golden[:0], tag[:0], owner[:0]))[1] == {"mismatches": 0}
    assert compare(drawn.outputs, (beats[:0], golden[:0], tag[:0], owner[:0]))[1]["mismatches"] == 8


def test_normals_are_compared_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    """A wrong bit anywhere in a normal, its tag or its end of line is one mismatch."""
    settings = frame.Settings(mesh="sphere", path="normals", camera=Camera(size=40))
    run = sim.Model.run
    parts = [("tdata", 1 << bit) for bit in (0, 17, 18, 35, 36, 53)] + [("tuser", 1), ("tuser", 1 << 15), ("tlast", 1)]
    for part, flip in parts:

        def faulty(self: sim.Model, *, name: str = f"m_axis_normal_{part}", flip: int = flip, **inputs) -> sim.Run:
            result = run(self, **inputs)
            result.outputs[name][100] ^= flip
            return result

        monkeypatch.setattr(sim.Model, "run", faulty)
        report = frame.render(settings).report
        first = report["first_mismatch"]
        assert (report["mismatches"], first["pixel"]) == (1, 100)
        different = int(first["expected"], 16) ^ int(first["actual"], 16)
        lsb = {"tdata": 0, "tuser": k.NORMAL_DATA_W, "tlast": k.NORMAL_DATA_W + k.TAG_W}[part]
        assert different == flip << lsb


# ---- whole frames ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("evaluator", ["horner", "fdiff"])
def test_more_records_than_tags(evaluator: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Tags come round again in a frame of more than 2^16 records; here, with fewer tags, much earlier."""
    monkeypatch.setattr(frame, "TAGS", 7)
    settings = frame.Settings(mesh="sphere", camera=Camera(size=40), evaluator=evaluator)
    assert frame.render(settings).report["mismatches"] == 0


def test_a_fault_of_the_rtl_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    """From the model's outputs into report, error and picture."""
    settings = frame.Settings(mesh="sphere", camera=Camera(size=40))
    sound = frame.render(settings)
    run = sim.Model.run

    def faulty(self: sim.Model, **inputs: np.ndarray) -> sim.Run:
        result = run(self, **inputs)
        result.outputs["m_axis_pixel_tdata"][100] ^= 0x8000
        return result

    monkeypatch.setattr(sim.Model, "run", faulty)
    broken = frame.render(settings)
    assert broken.report["mismatches"] == 1
    assert broken.report["first_mismatch"]["pixel"] == 100
    assert broken.report["max_error"] > 0.4 > sound.report["max_error"]
    assert np.count_nonzero(broken.intensity != sound.intensity) == 1
    assert list(itertools.compress(range(1600), sound.visible == 100)) != []  # and it is one that is seen
    before, after = (np.array(f.picture(f.intensity)).reshape(-1, 3) for f in (sound, broken))
    assert np.flatnonzero((before != after).any(axis=1)).tolist() == np.flatnonzero(sound.visible == 100).tolist()
