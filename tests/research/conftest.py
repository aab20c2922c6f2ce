"""What the tests of the research share with those of the integration."""

import sys
from pathlib import Path

from tests.workflow.conftest import tree  # noqa: F401  # a fixture

sys.path.append(str(Path(__file__).parents[1] / "unit" / "motion"))
