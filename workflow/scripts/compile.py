"""Compile the search for pulses, the closed form and the integration once, saying how long it takes."""

from pathlib import Path

from rocking.assessment.compilation import compile_all
from rocking.study.terminal import line_writer

compile_all(line_writer(Path(snakemake.log[0])))
