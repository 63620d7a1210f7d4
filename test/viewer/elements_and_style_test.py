# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes mistakes in the elements and the style of the page: elements_and_style_test.py VIEWER NODE TIDY MODULES."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

VIEWER, *TOOLS = sys.argv[1:5]
SOURCE = "src/display/write_page.cpp"


def answer(name, old, new, tools):
    """What the checker says of a page in one of whose files a text was replaced."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        shutil.copytree(VIEWER, root / "viewer")
        (root / SOURCE).parent.mkdir(parents=True)
        shutil.copy(pathlib.Path(VIEWER).parent / SOURCE, root / SOURCE)
        text = (root / "viewer" / name).read_text()
        if old not in text:
            raise ValueError(f"{old} is not in {name}")
        (root / "viewer" / name).write_text(text.replace(old, new, 1))
        checker = pathlib.Path(__file__).with_name("elements_and_style.py")
        return subprocess.run([sys.executable, "-B", checker, root / "viewer", *tools], capture_output=True, text=True,
                              check=False).stdout


class Elements_and_style(unittest.TestCase):
    def assert_fault(self, words, name, old, new):
        self.assertIn(words, answer(name, old, new, TOOLS))

    def test_a_value_of_one_theme(self):
        self.assert_fault("#d9deZZ: Mismatch", "page.css", "--line: #d9dee7", "--line: #d9deZZ")

    def test_a_custom_property_of_another_theme_alone(self):
        self.assert_fault("the first theme does not set --acent", "page.css", "--accent: #86aaff", "--acent: #86aaff")

    def test_a_custom_property_that_is_not_set(self):
        self.assert_fault("no rule sets --txt", "page.css", "color: var(--text)", "color: var(--txt)")

    def test_a_property(self):
        self.assert_fault("Unknown property", "page.css", "overflow: hidden", "overflw: hidden")

    def test_a_pseudo_class(self):
        self.assert_fault("there is no pseudo-class activ", "page.css", "#view:active", "#view:activ")

    def test_a_media_feature(self):
        self.assert_fault("there is no media feature", "page.css", "prefers-color-scheme", "prefers-colour-scheme")

    def test_a_function_with_too_few_arguments(self):
        self.assert_fault("clamp() has 2 arguments", "page.css", "max-width: min(", "max-width: clamp(")

    def test_a_rule_for_no_element(self):
        self.assert_fault("nothing in the page is called blink", "page.css", "h1 {", "blink {")

    def test_an_element(self):
        self.assert_fault("<dv> is not recognized", "stage.html", '<div id="hint">', '<dv id="hint">')

    def test_tools_that_say_nothing(self):
        said = answer("stage.html", "<div", "<div", ["true", "true", TOOLS[2]])
        self.assertIn("HTML Tidy says nothing", said)
        self.assertIn("CSSTree says nothing", said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=0)
