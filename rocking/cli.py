"""The `rocking` command: few verbs, each one call of the same functions as the workflow."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from rocking.errors import RockingError
from rocking.units import GRAVITY


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status: 0, or 1 after a sentence on what is wrong."""
    options = _parser().parse_args(arguments)
    try:
        options.run(options)
    except RockingError as error:
        print(f"rocking: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"rocking: {error.filename or 'file'}: {error.strerror or error}.", file=sys.stderr)
        return 1
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="rocking", description="Rocking structures under recorded earthquakes."
    )
    verbs = parser.add_subparsers(required=True, metavar="verb")
    start = _verb(verbs, "start", _start, "start a study in a folder of your own")
    start.add_argument("folder", type=Path)
    catalogue = _verb(verbs, "catalogue", _catalogue, "write a catalogue of the accelerograms in a folder")
    catalogue.add_argument("folder", type=Path)
    catalogue.add_argument(
        "--output", type=Path, help="CSV file to write (default: catalogue.csv in the folder)"
    )
    run = _verb(verbs, "run", _run, "run the study in a folder; what follows -- goes to snakemake")
    run.add_argument("folder", type=Path)
    run.add_argument("snakemake", nargs="*", help="options for snakemake, after --")
    _record_verb(verbs, "read", _read, "read a file and say what it is")
    _record_verb(verbs, "pulse", _pulse, "dominant sine pulse of each component of a file")
    assess = _record_verb(verbs, "assess", _assess, "assess one structure under one file")
    assess.add_argument("structures", type=Path, help="YAML file that lists structures")
    assess.add_argument("name", nargs="?", help="name of one structure in the list (default: all)")
    assess.add_argument("--report", type=Path, help="PDF file to write")
    spectrum = _record_verb(verbs, "spectrum", _spectrum, "rocking spectrum of a file as CSV")
    spectrum.add_argument("--restitution", type=float, default=0.9)
    spectrum.add_argument("--output", type=Path, default=Path("spectrum.csv"))
    return parser


def _verb(verbs, name: str, function, text: str) -> argparse.ArgumentParser:
    parser = verbs.add_parser(name, help=text, description=text)
    parser.set_defaults(run=function)
    return parser


def _record_verb(verbs, name: str, function, text: str) -> argparse.ArgumentParser:
    parser = _verb(verbs, name, function, text)
    parser.add_argument("file", type=Path, help="accelerogram in any known format")
    parser.add_argument(
        "--unit", help="unit of the numbers, where the format does not say it: m/s2, cm/s2, g, ..."
    )
    parser.add_argument("--time-step", type=float, help="time step in s, where the file does not say it")
    parser.add_argument("--scale", type=float, default=1.0, help="factor on the accelerations")
    return parser


def _accelerograms(options: argparse.Namespace):
    from rocking.records import read

    accelerograms = read(options.file, unit=options.unit, time_step=options.time_step)
    return [a if options.scale == 1 else a.scaled(options.scale) for a in accelerograms]


def _start(options: argparse.Namespace) -> None:
    from rocking.own_study import start

    for path in start(options.folder):
        print(path)
    print(
        f"Put your records into {options.folder / 'records'}, then: rocking catalogue {options.folder / 'records'}"
    )
    print(f"Then: rocking run {options.folder}")


def _catalogue(options: argparse.Namespace) -> None:
    from rocking.own_study import write_catalogue

    target = options.output or options.folder / "catalogue.csv"
    count, unread = write_catalogue(options.folder, target)
    print(f"{target}: {count} records")
    for name, reason in unread:
        print(f"not read: {name}: {reason}")


def _run(options: argparse.Namespace) -> None:
    from rocking.own_study import run

    raise SystemExit(run(options.folder, options.snakemake))


def _read(options: argparse.Namespace) -> None:
    for accelerogram in _accelerograms(options):
        print(
            f"{accelerogram.source.format}: {accelerogram.event or 'event not named'}, "
            f"{accelerogram.station or 'station not named'}, component {accelerogram.component or 'not named'}: "
            f"{accelerogram.acceleration.size} samples every {accelerogram.time_step:g} s, "
            f"peak {accelerogram.peak_acceleration:.4f} m/s² = {accelerogram.peak_acceleration / GRAVITY:.4f} g"
        )
        for sentence in (*accelerogram.processing, *accelerogram.warnings):
            print(f"  {sentence}")


def _pulse(options: argparse.Namespace) -> None:
    from rocking.pulses import extract_pulses

    for accelerogram in _accelerograms(options):
        analysis = extract_pulses(accelerogram)
        pulse = analysis.dominant
        print(
            f"component {accelerogram.component or 'not named'}: amplitude {pulse.amplitude:.4f} m/s² = "
            f"{pulse.amplitude / GRAVITY:.4f} g, period {pulse.period:.4f} s, start {pulse.start_time:.3f} s, "
            f"explains {analysis.explained_energy:.0%} of the acceleration energy"
        )
        for flag in analysis.flags:
            print(f"  {flag}")


def _assess(options: argparse.Namespace) -> None:
    from rocking.own_study import assess_file

    lines, report = assess_file(
        _accelerograms(options), options.structures, options.name, options.report is not None
    )
    print("\n".join(lines))
    if options.report is not None:
        from rocking.tables import write_whole

        write_whole(options.report, report)


def _spectrum(options: argparse.Namespace) -> None:
    from rocking.own_study import write_spectrum

    write_spectrum(_accelerograms(options), options.restitution, options.output)
    print(options.output)


if __name__ == "__main__":
    raise SystemExit(main())
