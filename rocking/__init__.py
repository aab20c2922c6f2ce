"""Rocking structures under recorded earthquakes: SI units and radians inside.

Every public name is imported when it is first used, so that a script pays only for what it needs.
"""

from importlib import import_module

_PUBLIC = {
    "rocking.records": ("Accelerogram", "read"),
    "rocking.pulses": ("Light", "Pulse", "PulseAnalysis", "PulseSettings", "extract_pulses"),
    "rocking.structures": (
        "Arch",
        "Block",
        "EquivalentBlock",
        "Frame",
        "Mechanism",
        "RigidBody",
        "Side",
        "Spire",
        "Wall",
        "structure_from_config",
    ),
    "rocking.sine_pulse": ("Maximum", "Regime", "predict_maximum", "printed_maximum"),
    "rocking.motion": ("Response", "integrate", "integrate_many"),
    "rocking.structures.outcome": ("Outcome",),
    "rocking.motion.spectrum": ("rocking_spectrum",),
    "rocking.errors": (
        "CatalogueError",
        "ConfigurationError",
        "MotionError",
        "PulseError",
        "RecordError",
        "RockingError",
        "StructureError",
        "UnknownFormatError",
    ),
}
_MODULE_OF = {name: module for module, names in _PUBLIC.items() for name in names}

__all__ = sorted(_MODULE_OF)  # noqa: PLE0605


def __getattr__(name: str) -> object:
    if name not in _MODULE_OF:
        raise AttributeError(f"module 'rocking' has no attribute {name!r}")
    value = getattr(import_module(_MODULE_OF[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
