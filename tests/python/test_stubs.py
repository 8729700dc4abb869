"""The type stubs and the docs say what the module has: read as text, compared with the real thing."""

import ast
import inspect
import pathlib
import re

import pytest

import marrow

ROOT = pathlib.Path(__file__).parents[2]
STUB = ast.parse((ROOT / "apps/python/marrow/__init__.pyi").read_text())


def named(kind, nodes):
    return {node.name: node for node in nodes if isinstance(node, kind)}


CLASSES = named(ast.ClassDef, STUB.body)
FUNCTIONS = named(ast.FunctionDef, STUB.body)
OPTIONS = [node.target.id for node in CLASSES["_Options"].body]


def stub_arguments(function):
    """(name, has a default) of each, and whether there are keywords."""
    names = [a.arg for a in function.args.args]
    plain = len(names) - len(function.args.defaults)
    return ([(name, i >= plain) for i, name in enumerate(names) if name != "self"],
            function.args.kwarg is not None)


def real_arguments(function):
    """The same, from the line that pybind11 puts before the words of a function."""
    line = function.__doc__.splitlines()[0]
    inner = re.fullmatch(r"\w+\((.*)\) -> .*", line).group(1)
    while (shorter := re.sub(r"\[[^\[\]]*\]", "", inner)) != inner:
        inner = shorter
    parts = [part.strip() for part in inner.split(",") if part.strip()]
    return ([(part.split(":")[0], "=" in part) for part in parts
             if not part.startswith(("self", "**"))], "**kwargs" in parts)


def public(names):
    return {name for name in names if not name.startswith("_")}


def test_the_same_names():
    assert public(FUNCTIONS) | public(CLASSES) == public(marrow.__all__)
    assert public(named(ast.FunctionDef, CLASSES["Skeleton"].body)) == public(dir(marrow.Skeleton))


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_have_these_arguments(name):
    assert stub_arguments(FUNCTIONS[name]) == real_arguments(getattr(marrow, name))


@pytest.mark.parametrize("name", sorted(public(dir(marrow.Skeleton)) | {"__init__"}))
def test_members_have_these_arguments(name):
    stub = named(ast.FunctionDef, CLASSES["Skeleton"].body)[name]
    real = inspect.getattr_static(marrow.Skeleton, name)
    is_property = any(getattr(d, "id", "") == "property" for d in stub.decorator_list)
    assert is_property == isinstance(real, property)
    if not is_property:
        assert stub_arguments(stub) == real_arguments(real)


@pytest.mark.parametrize("option", OPTIONS)
def test_options_are_known(option):
    """A value of no use is refused for itself, not for its name."""
    with pytest.raises((RuntimeError, TypeError, ValueError)) as refusal:
        marrow.extract([[0.0, 0.0, 0.0]], **{option: object()})
    assert "unknown keyword" not in str(refusal.value)


def test_options_are_all_there_are():
    words = inspect.getdoc(marrow.extract).split("Keywords:")[1].split("Other Python threads")[0]
    assert sorted(OPTIONS) == sorted(re.findall(r"(?:^|\. )(\w+):", words, re.MULTILINE))


def test_choices_are_those_of_the_module():
    for node in CLASSES["_Options"].body:
        for choice in re.findall(r"'(\w+)'", ast.unparse(node.annotation)):
            with pytest.raises(marrow.Error) as refusal:
                marrow.extract([[0.0, 0.0, 0.0]], **{node.target.id: choice})
            assert refusal.value.kind != "usage", choice


def test_the_docs_name_every_option():
    page = (ROOT / "docs/python.md").read_text()
    assert [option for option in OPTIONS if not re.search(f"`{option}[`=]", page)] == []
