"""The programs of the page pass their unit tests in node."""

import os
import re
import subprocess

import pytest
from conftest import named_file


def test_the_programs_of_the_page_pass_their_own_tests_in_node(page_file, found):
    folder = page_file.parent / "web"
    if not folder.is_dir():
        pytest.skip("the page was not made here: the packages that its programs use are not beside it")
    environment = {**os.environ, "DATA": str(page_file.parent / "data.json")}
    ran = subprocess.run([named_file("NODE"), "--test"], cwd=folder, env=environment, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stdout
    passed = int(re.search(r"^(?:#|ℹ) pass (\d+)$", ran.stdout, re.MULTILINE)[1])
    assert passed > 0
    found(f"{passed} tests")
