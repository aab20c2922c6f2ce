"""What the tests of the research share with those of the workflow."""

from tests.workflow.conftest import tree  # noqa: F401  # a fixture
