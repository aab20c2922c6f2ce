"""The types of structure there are: one line each, and the only place that knows them all."""

from importlib import import_module

from rocking.structures.structure import Structure

_CLASSES = (
    "rocking.structures.block.Block",
    "rocking.structures.wall.Wall",
    "rocking.structures.arch.Arch",
    "rocking.structures.frame.Frame",
    "rocking.structures.spire.Spire",
    "rocking.structures.rigid_body.RigidBody",
    "rocking.structures.facade.Facade",
    "rocking.structures.loaded_wall.LoadedWall",
    "rocking.structures.arch_on_piers.ArchOnPiers",
)


def _found(path: str) -> type[Structure]:
    module, name = path.rsplit(".", 1)
    return getattr(import_module(module), name)  # type: ignore[no-any-return]


TYPES: dict[str, type[Structure]] = {each.type_name: each for each in map(_found, _CLASSES)}
"""By the `type` of a structure list."""
