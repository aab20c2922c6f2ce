"""A Griffe extension: the pages on Python print the plain type of a value, not what a structure list reads of it."""

from collections.abc import Iterator

from griffe import Attribute, Expr, ExprName, ExprSubscript, ExprTuple, Extension, Module, Object, Parameter

Annotation = str | Expr | None


class PlainTypes(Extension):
    """`Annotated[float, length(…)]` reads `float`, and so does the name of such a type."""

    def on_package(self, *, pkg: Module, **_: object) -> None:
        for value in _values(pkg):
            value.annotation = _plain(value.annotation, pkg)


def _values(part: Object) -> Iterator[Attribute | Parameter]:
    """Yield every attribute, of which Griffe makes the parameters of a dataclass, and every parameter of a function."""
    for member in part.members.values():
        if member.is_alias:
            continue
        if member.is_attribute:
            yield member
        elif member.is_function:
            yield from member.parameters
        else:
            yield from _values(member)


def _plain(annotation: Annotation, package: Module) -> Annotation:
    """Return the type that an annotation says, without what it says besides."""
    if isinstance(annotation, ExprName) and annotation.canonical_path.startswith(f"{package.path}."):
        target = package.modules_collection[annotation.canonical_path]
        return _plain(target.value, package) if target.is_attribute else annotation
    if isinstance(annotation, ExprSubscript) and annotation.canonical_path == "typing.Annotated":
        assert isinstance(annotation.slice, ExprTuple)
        return _plain(annotation.slice.elements[0], package)
    return annotation
