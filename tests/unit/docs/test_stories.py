"""The stories of the documentation, as a reader follows them: files written, commands run, and what they print."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from docs.site.build import FOLDER

ROOT = FOLDER.parents[1]
STORIES = {
    "after_an_earthquake": "survey/results/summary/summary.pdf",
    "a_class_into_openquake": "class/results/fragility/fragility.pdf",
    "tie_for_a_code": "tie/results/summary/structures.pdf",
}
_BLOCK = re.compile(r"^```(sh|yaml|text)\n(.*?)^```$", re.M | re.S)


@pytest.mark.slow
@pytest.mark.parametrize("story", STORIES)
def test_a_story_ends_as_it_says(story, tmp_path):
    """A block of YAML is the file that its first line names; each line of a text is printed by what was run before."""
    (tmp_path / "records").symlink_to(ROOT / "records")
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    surroundings = os.environ | {"PATH": path, "PYTHONPATH": str(ROOT)}
    page = (FOLDER / f"{story}.md").read_text(encoding="utf-8")
    printed = ""
    counts = dict.fromkeys(("sh", "yaml", "text"), 0)
    for kind, content in _BLOCK.findall(page):
        counts[kind] += 1
        if kind == "yaml":
            (tmp_path / content.split()[1]).write_text(content, encoding="utf-8")
        elif kind == "sh":
            done = subprocess.run(
                ["bash", "-e", "-c", content],
                cwd=tmp_path,
                env=surroundings,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,  # the jobs of a run speak there, and a terminal shows both
                text=True,
                check=False,
            )
            assert done.returncode == 0, done.stdout
            printed += " ".join(done.stdout.split()) + " "
        else:
            for line in content.splitlines():
                assert " ".join(line.split()) in printed, (line, printed)
    assert min(counts.values()) >= 1
    assert (tmp_path / STORIES[story]).read_bytes().startswith(b"%PDF")
