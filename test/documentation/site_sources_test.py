# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests doc/site_sources.py with a small checkout."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "doc"))
import site_sources  # noqa: E402

HEADER = """#include <x>

namespace equiaffine {

/// A model of Solid_3, see doc/manual/page.md.
class Forward;
template <class T, internal::Parameter_chain... Parameters>
class Box {
  void member();
};
namespace internal {
class Hidden {};
} // namespace internal

template <class T>
auto volume_of(const T& t, const Parameters&... given) {
  return t;
}

} // namespace equiaffine
"""
FILES = {
    "include/equiaffine/solids/box.h": HEADER,
    "include/equiaffine/io/internal/secret.h": "class Secret {\n};\n",
    "doc/reference.dox": "- \\classified solids\n\n\\defgroup solids Solids\nText.\n\nHeaders: `solids/`, `io/`.\n\n",
    "doc/concepts/Solid_3.md": "# Solid_3\n",
    "doc/manual/page.md": "# Page\n",
    "doc/a.png": "",
    "examples/1.cpp": "",
    "LICENSE": "",
    "CHANGELOG.md": "# Changelog\n",
}


class SiteSources(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        for name, text in FILES.items():
            pathlib.Path(name).parent.mkdir(parents=True, exist_ok=True)
            pathlib.Path(name).write_text(text)
        for cached in (site_sources.groups, site_sources.concept_pages, site_sources.public_headers):
            cached.cache_clear()
            self.addCleanup(cached.cache_clear)

    def page(self, text, path="doc/manual/page.md"):
        pathlib.Path(path).write_text(text)
        return site_sources.Page(path).text()

    def test_every_file_is_written_with_its_lines(self):
        site_sources.main(pathlib.Path("site"))
        written = {path.relative_to("site").as_posix() for path in pathlib.Path("site").rglob("*") if path.is_file()}
        self.assertEqual({"include/equiaffine/solids/box.h", "doc/reference.dox", "doc/concepts/Solid_3.md",
                          "doc/manual/page.md", "CHANGELOG.md"}, written)
        header = pathlib.Path("site/include/equiaffine/solids/box.h").read_text()
        self.assertEqual(HEADER.count("\n"), header.count("\n"))
        self.assertIn("namespace equiaffine { /** \\begin{solids} */\n", header)
        self.assertTrue(header.endswith("/** @} */\n} // namespace equiaffine\n"))
        self.assertIn('/// A model of @ref concept_Solid_3 "Solid_3", see @ref manual_page "doc/manual/page.md".\n',
                      header)
        self.assertIn("template <class T, class... NamedParameters>\n", header)
        self.assertIn("const NamedParameters&... given", header)

    def test_names_that_differ_in_case_alone_have_one_order_for_every_seed_of_hashes(self):
        names = "Box", "box", "BOx", "bOx", "boX"
        pathlib.Path("include/equiaffine/solids/box.h").write_text("".join(f"class {name} {{\n}};\n" for name in names))
        for seed in range(5):
            subprocess.run([sys.executable, "-B", site_sources.__file__, f"site{seed}"], check=True,
                           env=os.environ | {"PYTHONHASHSEED": str(seed)})
        written = {pathlib.Path(f"site{seed}/doc/reference.dox").read_text() for seed in range(5)}
        self.assertEqual(1, len(written), written)

    def test_signatures_show_what_a_user_understands(self):
        for code, shown in (
                ("internal::Parameter_chain P = internal::No_parameters>",
                 "class P = decltype(parameters::default_values())>"),
                ("inline internal::No_parameters default_values()", "inline auto default_values()"),
                ("std::vector<A, internal::Output_allocator<B<C, 3>>> x;", "std::vector<A, Unspecified> x;"),
                ("int Order = internal::default_order", "int Order = 4"),
                ("  /// The word internal::default_order in a comment.", None),
                ("#include <a/internal/Parameters>", None)):
            self.assertEqual(shown or code, site_sources.with_names_for_users(code))

    def test_classes_and_functions_are_listed_under_their_group(self):
        self.assertIn('- <b>\\ref solids</b>: \\ref equiaffine::Box "Box", \\ref equiaffine::volume_of "volume_of".\n',
                      site_sources.reference(FILES["doc/reference.dox"]))

    def test_a_header_of_no_group_is_refused(self):
        self.assertEqual("solids", site_sources.group_of("io/read.h"))
        with self.assertRaises(SystemExit):
            site_sources.group_of("other.h")

    def test_headings_have_the_anchors_of_sites_that_host_code(self):
        self.assertEqual("# Page {#manual_page}\n## What `f(x)` is {#manual_page_what-fx-is}\n"
                         "## Again {#manual_page_again}\n## Again {#manual_page_again-1}\n",
                         self.page("# Page\n## What `f(x)` is\n## Again\n## Again\n"))

    def test_links_lead_to_what_is_on_the_site(self):
        for link, expected in (("[s](../concepts/Solid_3.md)", "[s](@ref concept_Solid_3)"),
                               ("[s](../concepts/Solid_3.md#has-models)", "[s](@ref concept_Solid_3_has-models)"),
                               ("[h](#here)", "[h](@ref manual_page_here)"), ("![p](../a.png)", "![p](a.png)"),
                               ("[e](../../examples/1.cpp)", "[e](@ref 1.cpp)"),
                               ("[c](../concepts)", "[c](@ref concepts)"),
                               ("[LICENSE](../../LICENSE)", "`LICENSE`"),
                               ("[terms](../../LICENSE)", "terms (`LICENSE`)"),
                               ("[x](https://example.org)", "[x](https://example.org)")):
            self.assertEqual(f"a {expected} b\n", self.page(f"a {link} b\n"))

    def test_a_link_over_two_lines_becomes_one_and_keeps_the_number_of_lines(self):
        self.assertEqual("a [in two](@ref concept_Solid_3)\n b\n", self.page("a [in\ntwo](../concepts/Solid_3.md) b\n"))

    def test_names_in_code_spans_are_links(self):
        for span, expected in (("`Box<T>`", '<code>@ref equiaffine::Box "Box"&lt;T&gt;</code>'),
                               ("`equiaffine::volume_of(t)`", '<code>@ref equiaffine::volume_of "volume_of"(t)</code>'),
                               ("`Hidden`", "`Hidden`"), ("`Secret`", "`Secret`"), ("`Boxes`", "`Boxes`"),
                               ("`--a\\|b`", "<code>\\--a\\|b</code>"), ("Solid_3", '@ref concept_Solid_3 "Solid_3"')):
            self.assertEqual(f"a {expected} b\n", self.page(f"a {span} b\n"))

    def test_code_stays_as_it_is(self):
        code = "```cpp\n# Box `Box` [x](../concepts/Solid_3.md)\n```\n\n    Solid_3\n"
        self.assertEqual(code, self.page(code))
        self.assertEqual("```sh\n$ ls\n```\n", self.page("```console\n$ ls\n```\n"))


if __name__ == "__main__":
    unittest.main()
