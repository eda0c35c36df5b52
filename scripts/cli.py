"""The command ``polyshade``. A fault of the input is one line on standard error and exit status 2."""

from __future__ import annotations

import os
import shlex
import sys
from pathlib import Path

import click
from click.core import ParameterSource

from golden.reference.light import MODELS
from sim import SimulationError, frame
from sim.errors import UserError
from sim.scene.camera import PROJECTIONS, Camera
from sim.sources import BUILD

VIEW = Camera()
PATH_OF = {"degree": "poly", "evaluator": "poly", "variant": "normals", "threshold": "normals"}  # options of one path


@click.group(
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110, "show_default": True},
    no_args_is_help=False,
)
@click.version_option(package_name="polyshade")
def cli() -> None:
    """Polynomial shading in synthesizable SystemVerilog, equal to its golden model bit for bit."""


@cli.command()
@click.option("--mesh", default="head", help="head, sphere, or an OBJ, PLY, STL, OFF, glTF or GLB file.")
@click.option("--subdivide", default=0, help="Catmull-Clark steps, 0 to 4.")
@click.option("--size", default=VIEW.size, help="Width and height in pixels, 16 to 4096.")
@click.option("--form", default="refined", help="refined, or paper: exactly what the papers print.")
@click.option("--degree", default=3, help="Of path poly: degree of every span in form paper, 1 to 3.")
@click.option("--path", default="poly", help="poly: a polynomial along each span; normals: a unit normal every pixel.")
@click.option(
    "--evaluator", default="horner", help="Of path poly: horner, a multiplier a step; fdiff, forward differences."
)
@click.option("--variant", default="refined", help="Of path normals: refined, exact, V1 to V6.")
@click.option("--threshold", default=0.9, help="Of path normals: length below which V1, V2, V4, V5 normalize, 0 to 1.")
@click.option("--model", default="blinn", help=f"Light: {', '.join(MODELS)}.")
@click.option("--shininess", default=32.0, help="Exponent n of the highlight, 1 to 1024.")
@click.option(
    "--light", nargs=3, type=float, default=(0.3, 0.6, 0.8), help="Direction to the light: right, up, viewer."
)
@click.option("--projection", default=VIEW.projection, help=f"{', '.join(PROJECTIONS)}.")
@click.option("--yaw", default=VIEW.yaw, help="Degrees, turns the mesh to the viewer's right.")
@click.option("--pitch", default=VIEW.pitch, help="Degrees, tips the mesh's top to the viewer.")
@click.option("--zoom", default=VIEW.zoom, help="Factor on the fitted scale.")
@click.option("--field-of-view", default=VIEW.field_of_view, help="Degrees, of a perspective view.")
@click.option("--out", default=None, help="Folder.  [default: build/render/<mesh>]")
def render(size: int, projection: str, yaw: float, pitch: float, zoom: float, field_of_view: float, **options) -> None:
    """One frame through the RTL: image.png, reference.png, difference.png, report.json.

    Every pixel is compared with the golden model; exit status 1 if any differs.
    """
    out = options.pop("out")
    camera = Camera(size, projection, yaw, pitch, zoom, field_of_view)
    settings = frame.Settings(camera=camera, **options)
    for name, path in PATH_OF.items():
        given = click.get_current_context().get_parameter_source(name) is not ParameterSource.DEFAULT
        if given and path != settings.path:
            raise UserError(f"--{name}: is without effect on path {settings.path}, allowed with --path {path}")
    if out is not None and (not out or "\0" in out or (os.path.exists(out) and not os.path.isdir(out))):
        raise UserError(f"--out {out!r}: is no folder, allowed a folder or a new name")
    folder = BUILD / "render" / Path(settings.mesh).stem if out is None else Path(out)
    try:
        picture = frame.render(settings)
    except SimulationError as error:
        click.echo(f"{error}; again with a waveform: WAVES=1 {rerun()}", err=True)
        sys.exit(1)
    picture.save(folder)
    report, image = picture.report, click.format_filename(folder / "image.png")
    click.echo(
        f"{image}: {report['pixels']} pixels of {report['spans']} spans in {report['cycles']} clocks, "
        f"{report['mismatches']} mismatches, NMSE {report['nmse'] or 0:.1e}"
    )
    if report["mismatches"]:
        *told, (_, again) = report["first_mismatch"].items()
        first = ", ".join(f"{name} {value}" for name, value in told)
        click.echo(f"first mismatch: {first}; again with a waveform: {again}", err=True)
        sys.exit(1)


def rerun() -> str:
    """The command line that was typed, to be pasted into a shell."""
    return shlex.join(["polyshade", *sys.argv[1:]])


@cli.command()
@click.option("--vectors", default=1_000_000, help="Vectors a unit and form where inputs are not exhausted.")
@click.option("--seed", default=1, help="Seed of the random ones.")
def units(vectors: int, seed: int) -> None:
    """Measure every unit, both forms: vectors, mismatches, worst errors; leaves build/units.json."""
    from scripts import units as command

    sys.exit(command.main(vectors, seed))


@cli.command()
def bench() -> None:
    """Measure speed: simulator, cocotb, golden model; leaves build/bench.json."""
    from scripts import bench as command

    command.main()


@cli.command()
def papers() -> None:
    """Check every claim of the papers and draw their figures again; leaves build/papers.json."""
    from scripts import papers as command

    command.main()


@cli.command()
@click.argument("module", nargs=-1)
def synth(module: tuple[str, ...]) -> None:
    """Synthesize every module (or those named) for every FPGA family; leaves build/synth.json."""
    from scripts import synth as command

    command.main(list(module))


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
    except (KeyboardInterrupt, click.Abort):
        click.echo("polyshade: interrupted", err=True)
        sys.exit(130)
    click.echo(f"polyshade: error: {UserError(message)}", err=True)
    sys.exit(2)


if __name__ == "__main__":
    main()
