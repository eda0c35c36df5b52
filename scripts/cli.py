# SPDX-License-Identifier: Apache-2.0
"""The command ``polyshade``. A fault of the input is one line on standard error and exit status 2."""

from __future__ import annotations

import contextlib
import os
import shlex
import sys
from collections.abc import Iterator
from dataclasses import fields
from pathlib import Path

import click
from click.core import ParameterSource
from polyshade.golden.material import MODELS, Material
from polyshade.golden.reference.light import ROWS
from polyshade.sim import SimulationError, batch, frame
from polyshade.sim.errors import UserError
from polyshade.sim.scene.camera import PROJECTIONS, Camera
from polyshade.sim.sources import BUILD

VIEW, SURFACE = Camera(), Material()
LOBES = tuple(model for model in MODELS if model != "lambert")
NEEDS = {  # options that have an effect with some values of others only, which are named from the outermost in
    "degree": {"path": ("line",), "form": ("paper",)},
    "criterion": {"path": ("line",), "model": ("lambert",)},
    "evaluator": {"path": ("line",)},
    "variant": {"path": ("normals",)},
    "threshold": {"path": ("normals",), "variant": ("V1", "V2", "V4", "V5")},
    "shininess": {"model": ("phong", "blinn", "schlick")},
    "roughness": {"model": ("cook-torrance", "ward")},
    "f0": {"model": ("cook-torrance",)},
    "energy": {"model": ("phong", "blinn")},
    **{option: {"model": LOBES} for option in ("exposure", "specular", "highlight")},
    "field_of_view": {"projection": ("perspective",)},
}


class Interrupted(Exception):
    """Control-C; click itself would answer it with an empty line."""


class Commands(click.Group):
    """The commands."""

    def invoke(self, ctx: click.Context) -> object:
        """click's hook."""
        try:
            return super().invoke(ctx)
        except KeyboardInterrupt as error:
            raise Interrupted from error


@click.group(
    cls=Commands,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110, "show_default": True},
    no_args_is_help=False,
)
@click.version_option(package_name="polyshade")
def cli() -> None:
    """Polynomial shading in synthesizable SystemVerilog, equal to its golden model bit for bit."""


class Exposure(click.ParamType):
    """A number, or "auto"."""

    name = "auto|float"

    def convert(self, value, param, ctx) -> float | str:
        """click's hook."""
        return value if value == "auto" else click.FLOAT.convert(value, param, ctx)


def colour(option: str, default: tuple[float, float, float], help: str):
    """An option of three parts, red, green and blue."""
    return click.option(option, nargs=3, type=float, default=default, help=f"{help}: red, green, blue, 0 to 1 each.")


@cli.command()
@click.argument("file", required=False)
@click.option("--mesh", default="head", help="head, sphere, or an OBJ, PLY, STL, OFF, glTF or GLB file: as FILE.")
@click.option("--subdivide", default=0, help="Catmull-Clark steps, 0 to 4.")
@click.option(
    "--crease",
    type=float,
    default=None,
    help="Compute all normals, smooth across edges of so many degrees, 0 to 180.  [default: the file's normals; "
    "where it has none 60, of glTF 0]",
)
@click.option("--flat", is_flag=True, help="Flat faces: --crease 0.")
@click.option("--flip", is_flag=True, help="Turn all faces inside out.")
@click.option("--two-sided", is_flag=True, help="Show the backs of faces too, lit from their side.")
@click.option("--up", default="y", help="The file's axis that points up: y or z.")
@click.option("--size", default=VIEW.size, help="Width and height in pixels, 16 to 4096.")
@click.option("--scan", help="rtl, the default where it can: set-up and scan conversion in the RTL; host: by NumPy.")
@click.option("--form", default="refined", help="refined, or paper: exactly what the papers print.")
@click.option("--degree", default=3, help="Of path line: degree of every span in form paper, 1 to 3.")
@click.option(
    "--path",
    default="line",
    help="line: a polynomial along each span; normals: a unit normal every pixel; patch: one in boxes of triangles; "
    "direct: light at every pixel from scalars, without a normal; vector: by the yardstick, a unit normal every pixel.",
)
@click.option(
    "--evaluator", default="fdiff", help="Of path line: fdiff, forward differences; horner, a multiplier a step."
)
@click.option("--variant", default="refined", help="Of path normals: refined, exact, V1 to V6.")
@click.option("--threshold", default=0.9, help="Of path normals: length below which V1, V2, V4, V5 normalize, 0 to 1.")
@click.option("--criterion", default=0.005, help="Of lambert: eta of triangles drawn without normalizing, 0 to 1.")
@click.option("--lanes", default=1, help="Parallel lanes: 1, 2 or 4, of path patch also 8.")
@click.option(
    "--light-unit", default="full", help="full: a node a clock; folded: six clocks a node, fewer multipliers."
)
@click.option("--model", default=SURFACE.model, help=f"Light: {', '.join(MODELS)}.")
@click.option("--shininess", default=SURFACE.shininess, help="phong, blinn, schlick: exponent n, 1 to 1024.")
@click.option("--roughness", default=SURFACE.roughness, help="cook-torrance, ward: slope m, 0.05 to 0.7.")
@click.option("--f0", default=SURFACE.f0, help="cook-torrance: reflectance at normal incidence, 0 to 1.")
@click.option("--energy", default=SURFACE.energy, help=f"Scale of phong or blinn: none, {', '.join(ROWS)}.")
@click.option("--exposure", type=Exposure(), default=SURFACE.exposure, help="auto, or a factor on the highlight.")
@click.option("--ambient", default=SURFACE.ambient, help="Weight of ambient light, 0 to 1.")
@click.option("--diffuse", default=SURFACE.diffuse, help="Weight of diffuse light, 0 to 1.")
@click.option("--specular", default=SURFACE.specular, help="Weight of the highlight, 0 to 1.")
@colour("--colour", SURFACE.colour, "Of ambient and diffuse light")
@colour("--highlight", SURFACE.highlight, "Of the highlight")
@click.option(
    "--light",
    nargs=3,
    type=float,
    multiple=True,
    default=[(0.3, 0.6, 0.8)],
    help="Direction to the light: right, up, viewer. Of path patch up to four times.",
)
@click.option("--projection", default=VIEW.projection, help=f"{', '.join(PROJECTIONS)}.")
@click.option("--yaw", default=VIEW.yaw, help="Degrees, turns the mesh to the viewer's right.")
@click.option("--pitch", default=VIEW.pitch, help="Degrees, tips the mesh's top to the viewer.")
@click.option("--zoom", default=VIEW.zoom, help="Factor on the fitted scale.")
@click.option("--field-of-view", default=VIEW.field_of_view, help="Degrees, of a perspective view.")
@click.option("--frames", default=1, help="Views of a whole turn: animation.png in place of the three pictures.")
@click.option("--scheduler", default=None, help="Of --frames: a Dask scheduler.  [default: the cores of this machine]")
@click.option(
    "--out",
    default=None,
    help="Folder.  [default: render/<mesh>, in the repository build/render/<mesh>, of several frames <mesh>-turn]",
)
def render(
    file: str | None, size: int, projection: str, yaw: float, pitch: float, zoom: float, field_of_view: float,
    frames: int, scheduler: str | None, out: str | None, **options,
) -> None:  # fmt: skip
    """One frame through the RTL: image.png, reference.png, difference.png, report.json.

    Every pixel is compared with the golden model; exit status 1 if any differs.
    """
    if file is not None:
        if given("mesh"):
            raise UserError(f"--mesh: is given beside the file {file!r}, allowed is one of them")
        options["mesh"] = file
    if options.pop("flat"):
        if given("crease"):
            raise UserError("--crease: is given beside --flat, allowed is one of them")
        options["crease"] = 0.0
    options["light"], *more = options["light"]
    options["more_lights"] = tuple(more)
    camera = Camera(size, projection, yaw, pitch, zoom, field_of_view)
    settings = frame.Settings(camera=camera, material=material(options), **options)
    refuse_without_effect({**vars(camera), **vars(settings.material), **vars(settings)})
    if not 1 <= frames <= batch.FRAMES_MAX:
        raise UserError(f"--frames: {frames} is out of range, allowed is 1 to {batch.FRAMES_MAX}")
    if scheduler is not None and frames == 1:
        raise UserError("--scheduler: is without effect on one frame, allowed with --frames 2 and more")
    turns = frames > 1
    folder = folder_of(out, Path("render", Path(settings.mesh).stem + "-turn" * turns))
    try:
        frame.check_folder(folder, ["animation.png"] if turns else frame.PICTURES)
    except UserError:
        settings.load()  # a fault of the mesh, whose name may be the folder's, is told first
        raise
    with simulating():
        made = batch.shoot_all(batch.turntable(settings, frames), scheduler) if turns else frame.render(settings)
    made.save(folder)
    for hint in made.report.get("hints", made.report["frames"][0].get("hints", []) if turns else []):
        click.echo(f"polyshade: hint: {UserError(hint)}", err=True)
    image = click.format_filename(folder / ("animation.png" if turns else "image.png"))
    tell(image, made.report["frames"] if turns else [made.report])


def given(name: str) -> bool:
    """Whether an option was typed."""
    return click.get_current_context().get_parameter_source(name) is not ParameterSource.DEFAULT


def refuse_without_effect(settings: dict) -> None:
    """An option that was typed but changes nothing is a mistake, and told."""
    for name, needed in NEEDS.items():
        for what, allowed in needed.items():
            if given(name) and settings[what] not in allowed:
                option = name.replace("_", "-")
                effect = f"is without effect on {what} {settings[what]}"
                raise UserError(f"--{option}: {effect}, allowed with --{what} {', '.join(allowed)}")


def folder_of(out: str | None, default: Path) -> Path:
    """The folder of ``--out``; its default is below ``build`` in the repository, else below the current folder."""
    if out is None:
        return BUILD / default if Path.cwd().is_relative_to(BUILD.parent) else default
    if not out or "\0" in out or (os.path.exists(out) and not os.path.isdir(out)):
        raise UserError(f"--out {out!r}: is no folder, allowed a folder or a new name")
    return Path(out)


@contextlib.contextmanager
def simulating() -> Iterator[None]:
    """A module that stops ends the command with exit status 1, and the line to run it again."""
    try:
        yield
    except SimulationError as error:
        click.echo(f"{error}; again with a waveform: WAVES=1 {rerun()}", err=True)
        sys.exit(1)


def tell(image: str, reports: list[dict]) -> None:
    """A line about a picture of one frame or several; what differs from the golden model, and exit status 1, if any."""
    pixels, spans, cycles, mismatches = (
        sum(report[key] for report in reports) for key in ("pixels", "spans", "cycles", "mismatches")
    )
    nmse = max(report["nmse"] or 0 for report in reports)
    click.echo(
        f"{image}: path {reports[0]['path']}, {pixels} pixels of {spans} spans in {cycles} clocks, "
        f"{mismatches} mismatches, NMSE {nmse:.1e}"
    )
    for report in reports:
        for name, values in report.get("counter_mismatches", {}).items():
            click.echo(f"counter {name}: {values}", err=True)
        if first := dict(report.get("first_mismatch", {})):
            again = first.pop("again", f"WAVES=1 {rerun()}")
            told = ", ".join(f"{name} {value}" for name, value in first.items())
            click.echo(f"first mismatch: {told}; again with a waveform: {again}", err=True)
    if any({"first_mismatch", "counter_mismatches"} & report.keys() for report in reports):
        sys.exit(1)


def material(options: dict) -> Material:
    """The surface that the options describe, which are taken out of them."""
    try:
        return Material(**{part.name: options.pop(part.name) for part in fields(Material)})
    except ValueError as error:
        raise UserError(f"--{error}") from error


def rerun() -> str:
    """The command line that was typed, to be pasted into a shell."""
    return shlex.join(["polyshade", *sys.argv[1:]])


@cli.command()
@click.option("--mesh", default="head", help="As of render.")
@click.option("--size", default=256, help="Width and height of a picture in pixels, 16 to 4096.")
@click.option("--scheduler", default=None, help="A Dask scheduler.  [default: the cores of this machine]")
@click.option("--out", default=None, help="Folder.  [default: gallery, in the repository build/gallery]")
def gallery(mesh: str, size: int, scheduler: str | None, out: str | None) -> None:
    """Every model, energy scale and form through the RTL: gallery.png, report.json."""
    from polyshade.scripts.studies import gallery as command

    folder = folder_of(out, Path("gallery"))
    frame.check_folder(folder, ["gallery.png"])
    with simulating():
        made = command.shoot(mesh, size, scheduler)
    frame.save(folder, {"gallery.png": command.sheet(made)}, made.report)
    tell(click.format_filename(folder / "gallery.png"), made.report["frames"])


@cli.command()
@click.option("--vectors", default=1_000_000, help="Vectors a unit and form where inputs are not exhausted.")
@click.option("--seed", default=1, help="Seed of the random ones.")
def units(vectors: int, seed: int) -> None:
    """Measure every unit, both forms: vectors, mismatches, worst errors; leaves build/units.json."""
    from polyshade.scripts.studies import units as command

    sys.exit(command.main(vectors, seed))


@cli.command()
def bench() -> None:
    """Measure speed: simulator, cocotb, golden model; leaves build/bench.json."""
    from polyshade.scripts.studies import bench as command

    command.main()


@cli.command()
def papers() -> None:
    """Check every claim of the papers and draw their figures again; leaves build/papers.json."""
    from polyshade.scripts.studies import papers as command

    command.main()


@cli.command()
@click.argument("machine", nargs=-1)
def machines(machine: tuple[str, ...]) -> None:
    """Measure area, clock, speed and error of every path and number of lanes; leaves build/machines.json.

    Or of the named MACHINEs alone, such as patch/4/blinn/1. What is measured is kept as long as no source changes.
    """
    from polyshade.scripts.studies import machines as command

    command.main(list(machine))


@cli.command()
@click.argument("module", nargs=-1)
@click.option("--family", multiple=True, help="An FPGA family such as nexus; any number of times.")
def synth(module: tuple[str, ...], family: tuple[str, ...]) -> None:
    """Synthesize every module (or those named) for FPGA families; leaves build/synth.json."""
    from polyshade.scripts.flow import synth as command

    command.main(list(module), family)


@cli.command()
@click.argument("proof", nargs=-1)
def formal(proof: tuple[str, ...]) -> None:
    """Prove properties of the modules (or those named) and try their mutants; leaves build/formal.json."""
    from polyshade.scripts.flow import formal as command

    sys.exit(command.main(list(proof)))


@cli.command()
@click.argument("module", nargs=-1)
def gate(module: tuple[str, ...]) -> None:
    """Run the vectors of every unit (or those named) through netlists of FPGA cells; leaves build/gate.json."""
    from polyshade.scripts.flow import gate as command

    sys.exit(command.main(list(module)))


@cli.command()
@click.argument("configuration", nargs=-1)
def handoff(configuration: tuple[str, ...]) -> None:
    """Make the bundle for other designs (all machines or those named), try it; leaves build/handoff.tar.gz."""
    from polyshade.scripts.handoff import bundle as command

    sys.exit(command.main(list(configuration)))


@cli.command()
def soc() -> None:
    """Draw from C on a soft core of LiteX, in Verilator, and compare; leaves build/soc/report.json."""
    from polyshade.scripts.handoff import soc as command

    sys.exit(command.main())


@cli.command()
@click.argument("module", nargs=-1)
@click.option("--count", default=60, help="Faults of a module.")
@click.option("--seed", default=1, help="Seed of their choice.")
def mutants(module: tuple[str, ...], count: int, seed: int) -> None:
    """Put faults into every module (or those named) and see that its tests find them; leaves build/mutants.json."""
    from polyshade.scripts.flow import mutants as command

    sys.exit(command.main(list(module), count, seed))


@cli.command()
@click.argument("test", nargs=-1)
@click.option("--seeds", default=700, help="Items of random work for functional coverage.")
def coverage(test: tuple[str, ...], seeds: int) -> None:
    """Count what the tests (or those named) reach in the RTL; leaves build/coverage.json."""
    from polyshade.scripts.flow import coverage as command

    sys.exit(command.main(test, seeds))


@cli.command()
@click.option("--vectors", default=400_000, help="Vectors of a stage that are searched for the largest errors.")
@click.option("--seed", default=1, help="Seed of the random ones.")
def budget(vectors: int, seed: int) -> None:
    """Compare every stage's error with an oracle of 40 digits; leaves build/budget.json, docs/error-budget.md."""
    from polyshade.scripts.studies import budget as command

    sys.exit(command.main(vectors, seed))


@cli.command()
def report() -> None:
    """Put all that was measured on one page; leaves build/report/index.html."""
    from polyshade.scripts.drawings import page as command

    sys.exit(command.main())


@cli.command()
@click.option("--minutes", default=1.0, help="How long, 0.01 to 10080.")
@click.option("--seed", default=1, help="The first item's; the others follow.")
@click.option("--scheduler", default=None, help="A Dask scheduler.  [default: the cores of this machine]")
@click.option("--kind", default="", help="One item of this kind and seed, and what it gave.")
def soak(minutes: float, seed: int, scheduler: str | None, kind: str) -> None:
    """Random units, spans, triangles, stalls and resets against the golden model; leaves build/soak.json."""
    from polyshade.scripts.flow import soak as command

    sys.exit(command.main(minutes, seed, scheduler, kind))


@cli.command()
@click.argument("name")
def board(name: str) -> None:
    """Make the bitstream of a board (ulx3s); leaves build/board/."""
    from polyshade.scripts import boards

    boards.main(name)


def main(arguments: list[str] | None = None) -> None:
    """Run the command line; turn every fault of the user into one line and exit status 2."""
    try:
        status = cli.main(arguments, prog_name="polyshade", standalone_mode=False)
        sys.exit(status if isinstance(status, int) else 0)
    except UserError as error:
        message = str(error)
    except click.ClickException as error:
        message = f"{error.format_message()} (see polyshade --help)"
    except OSError as error:  # a disk that is full, a folder that cannot be written, a compiler that is missing
        message = str(error)
    except (Interrupted, KeyboardInterrupt, click.Abort):
        click.echo("polyshade: interrupted", err=True)
        sys.exit(130)
    click.echo(f"polyshade: error: {UserError(message)}", err=True)
    sys.exit(2)


if __name__ == "__main__":
    main()
