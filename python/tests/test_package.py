"""The package as a whole: its types, its command line, its documentation, and what an import costs."""

import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

import asperity as asp

HERE = Path(__file__).parent


def test_the_stubs_and_the_code_satisfy_a_type_checker() -> None:
    pytest.importorskip("mypy")
    command = [sys.executable, "-m", "mypy", "--config-file", "pyproject.toml"]
    ran = subprocess.run(command, cwd=HERE.parent, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stdout


def test_the_stubs_name_what_there_is() -> None:
    stubs = (Path(asp.__file__).parent / "_asperity.pyi").read_text()
    from asperity import _asperity

    for name, it in vars(_asperity).items():
        if name.startswith("_") or not (inspect.isclass(it) or callable(it)):
            continue
        assert re.search(rf"^(class|def) {name}\b", stubs, re.M), name
        if not inspect.isclass(it):
            continue
        body = re.split(r"^(?=class |def |@)", stubs.split(f"class {name}")[1], flags=re.M)[0]
        for member in vars(it):
            if not member.startswith("_"):
                assert re.search(rf"def {member}\b", body), f"{name}.{member}"


def test_everything_is_documented() -> None:
    for name in asp.__all__:
        it = getattr(asp, name)
        assert inspect.getdoc(it), name
        members = vars(it).items() if inspect.isclass(it) and it.__module__ == "asperity" else ()
        for member, value in members:
            assert member.startswith("_") or inspect.getdoc(value), f"{name}.{member}"


def test_the_command_line_is_in_the_package(tmp_path: Path) -> None:
    words = "solve --indenter sine --amplitude 0.01 --points 64 --size 1 --reduced-pressure 0.1 --out run.npz"
    ran = subprocess.run([sys.executable, "-m", "asperity", *words.split()], cwd=tmp_path, capture_output=True, text=True)
    assert ran.returncode == 0 and (tmp_path / "run.npz").exists(), ran.stderr
    said = subprocess.run([sys.executable, "-m", "asperity", "--version"], capture_output=True, text=True)
    assert said.stdout.startswith("asperity ")
    refused = subprocess.run([sys.executable, "-m", "asperity", "solve"], capture_output=True, text=True)
    assert refused.returncode == 2


def test_an_import_leaves_alone_what_takes_long(capsys: pytest.CaptureFixture[str]) -> None:
    code = "import time; t = time.perf_counter(); import asperity, sys; t = time.perf_counter() - t; " \
        "print(round(1000 * t), 'numpy' in sys.modules, 'typing' in sys.modules)"
    printed = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.split()
    with capsys.disabled():
        print(f"\n  import asperity: {printed[0]} ms")
    assert printed[1:] == ["False", "False"]
