#!/usr/bin/env python3
"""Each style check finds the fault it is there for, and only that: small trees with one fault each."""

import json
import shutil
import tempfile
import unittest
from pathlib import Path

import check_files
import check_format
import check_layers
import check_readme
import check_tidy
import check_tutorials

CONFIGURATION = Path(__file__).resolve().parents[2]
UNFINISHED = "TO" + "DO"  # in pieces: this file is checked too
ELSEWHERE = "/".join(("", "home", "someone", "case.toml"))


class SmallTree(unittest.TestCase):
    """A temporary tree; without git, the checks take every file below it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name).resolve()

    def write(self, path: str, content: str) -> None:
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(content)

    def assert_one(self, faults: list[str], *parts: str) -> None:
        self.assertEqual(len(faults), 1, faults)
        for part in parts:
            self.assertIn(part, faults[0])


class Layers(SmallTree):
    def faults(self, path: str, line: str) -> list[str]:
        self.write(path, "#pragma once\n" + line + "\n")
        return check_layers.check(self.root)

    def test_lower_layer_must_not_know_a_higher_one(self):
        self.assert_one(self.faults("lbm/a.hpp", '#include "dem/b.hpp"'), "lbm/a.hpp:2", "nothing of ours")

    def test_carriers_must_not_know_the_lattice(self):
        self.assert_one(self.faults("dem/a.cpp", '#  include "lbm/b.hpp"'), "dem/a.cpp:2")

    def test_geometry_must_not_know_the_lattice(self):
        self.assert_one(self.faults("lbm/geometry/a.hpp", '#include "lbm/rows.hpp"'), "knows no lattice")

    def test_only_derivation_may_use_carriers(self):
        self.assert_one(self.faults("micromodels/a.hpp", '#include "dem/walls.hpp"'), "derivation")

    def test_nobody_may_include_tests(self):
        self.assert_one(self.faults("tools/puffin/a.cpp", '#include "tests/lbm/a.hpp"'), "tools may include")

    def test_path_must_start_at_the_root(self):
        self.assert_one(self.faults("lbm/a.cpp", '#include "rows.hpp"'), "from the root")

    def test_solver_must_build_without_vtk(self):
        self.assert_one(self.faults("cases/a.cpp", "#include <vtkNew.h>"), "without VTK")

    def test_library_must_not_print(self):
        self.assert_one(self.faults("coupling/a.cpp", 'std::cout << "step";'), "std::cout")
        self.assert_one(self.faults("coupling/a.cpp", 'printf("step");'), "printf")

    def test_library_must_not_exit(self):
        self.assert_one(self.faults("dem/a.cpp", "  std::exit(1);"), "std::exit")

    def test_cplusplus_elsewhere_is_a_fault(self):
        self.assert_one(self.faults("extras/a.cpp", ""), "outside the folders")

    def test_what_the_order_allows_is_in_order(self):
        for path, line in (
            ("lbm/geometry/a.hpp", '#include "lbm/geometry/b.hpp"'),
            ("lbm/a.hpp", '#include "lbm/geometry/b.hpp"'),
            ("micromodels/derivation/a.hpp", '#include "dem/walls.hpp"'),
            ("micromodels/derivation/b.hpp", '#include "micromodels/law.hpp"'),
            ("coupling/a.hpp", '#include "micromodels/derivation/b.hpp"'),
            ("tools/output/a.cpp", "#include <vtkNew.h>"),
            ("tests/dem/a.cpp", '#include "tests/dem/b.hpp"'),
            ("dem/a.cpp", "// std::cout is not for libraries"),
            ("dem/b.cpp", 'throw std::runtime_error("printf(x)");'),
        ):
            self.assertEqual(self.faults(path, line), [], path)


class Files(SmallTree):
    def setUp(self):
        super().setUp()
        self.write("lbm/README.md", "Air.\n")

    def test_folder_needs_a_readme(self):
        self.write("dem/a.hpp", "")
        self.assert_one(check_files.check(self.root), "dem/", "README.md")

    def test_readme_is_short(self):
        self.write("lbm/README.md", "line\n" * 41)
        self.assert_one(check_files.check(self.root), "more than 40 lines")

    def test_other_folders_are_refused(self):
        self.write("utils/a.txt", "")
        self.assert_one(check_files.check(self.root), "utils/", "no such top-level folder")

    def test_unfinished_work_is_refused(self):
        self.write("lbm/a.hpp", f"// {UNFINISHED}: faster\n")
        self.assert_one(check_files.check(self.root), "lbm/a.hpp:1", UNFINISHED)

    def test_paths_of_a_machine_are_refused(self):
        self.write("lbm/a.toml", f'file = "{ELSEWHERE}"\n')
        self.assert_one(check_files.check(self.root), "lbm/a.toml:1", "one machine")

    def test_long_file_needs_a_reason(self):
        self.write("lbm/a.cpp", "// One table.\n" + "int x;\n" * 400)
        self.assert_one(check_files.check(self.root), "lbm/a.cpp", "401 lines")
        self.write("lbm/a.cpp", "// One table.\n// Long because the table is.\n" + "int x;\n" * 400)
        self.assertEqual(check_files.check(self.root), [])

    def test_dead_links_are_refused(self):
        self.write("lbm/README.md", "[rows](rows.hpp) [web](https://example.org/x) [here](#part)\n")
        self.assert_one(check_files.check(self.root), "rows.hpp leads nowhere")
        self.write("lbm/rows.hpp", "")
        self.assertEqual(check_files.check(self.root), [])

    def test_files_that_a_page_names_are_there(self):
        self.write("lbm/README.md", "See `lbm/rows.hpp`; write `lbm/NAME.hpp`.\n")
        self.assert_one(check_files.check(self.root), "there is no lbm/rows.hpp")
        self.write("CHANGELOG.md", "Gone: `lbm/old.hpp`.\n")
        self.write("lbm/rows.hpp", "")
        self.assertEqual(check_files.check(self.root), [])

    def test_binary_files_are_not_read_as_text(self):
        self.write("lbm/a.bin", "\0" + UNFINISHED)
        self.assertEqual(check_files.check(self.root), [])


class Format(SmallTree):
    def setUp(self):
        super().setUp()
        shutil.copy(CONFIGURATION / ".clang-format", self.root)

    def test_crooked_file_is_named(self):
        self.write("lbm/straight.cpp", "int x = 1;\n")
        self.assertEqual(check_format.check(self.root), [])
        self.write("lbm/crooked.cpp", "int   x=1 ;\n")
        self.assert_one(check_format.check(self.root), "lbm/crooked.cpp")

    def test_missing_program_is_a_fault(self):
        self.write("lbm/a.cpp", "int x = 1;\n")
        self.assert_one(check_format.check(self.root, "no-such-clang-format"), "tools/check installs it")


class Tidy(SmallTree):
    BAD = "inline int f(int x) {\n  if (x == 1) {\n    return 1;\n  } else {\n    return 1;\n  }\n}\n"

    def setUp(self):
        super().setUp()
        shutil.copy(CONFIGURATION / ".clang-tidy", self.root)

    def compile(self, *paths: str) -> None:
        commands = [{"directory": str(self.root), "file": path, "command": f"c++ -Wall -I{self.root} -c {path}"}
                    for path in paths]
        self.write("build/compile_commands.json", json.dumps(commands))

    def faults(self, which: str = "sources") -> list[str]:
        return check_tidy.check(self.root, self.root / "build", which)

    def test_suspicious_code_is_a_fault(self):
        self.write("lbm/a.cpp", self.BAD)
        self.compile("lbm/a.cpp")
        self.assert_one(self.faults(), "lbm/a.cpp", "bugprone-branch-clone")

    def test_our_headers_are_looked_at(self):
        self.write("lbm/a.hpp", "#pragma once\n" + self.BAD)
        self.write("lbm/a.cpp", '#include "lbm/a.hpp"\n')
        self.compile("lbm/a.cpp")
        self.assert_one(self.faults(), "lbm/a.hpp", "bugprone-branch-clone")

    def test_sources_and_tests_are_told_apart(self):
        self.write("lbm/a.cpp", "int twice(int x) { return 2 * x; }\n")
        self.write("tests/lbm/a.cpp", self.BAD)
        self.compile("lbm/a.cpp", "tests/lbm/a.cpp")
        self.assertEqual(self.faults("sources"), [])
        self.assert_one(self.faults("tests"), "tests/lbm/a.cpp")

    def test_files_looked_at_together_are_reported_alone(self):
        helper = "namespace {\nint helper(int x) { return x + 1; }\n}\n"  # the same name twice is no fault
        self.write("lbm/a.cpp", helper + "int a() { return helper(1); }\n")
        self.write("lbm/b.cpp", helper + self.BAD.replace("inline int f", "int b") + "int c() { return helper(2); }\n")
        self.write("lbm/c.cpp", "int d() { return 1; }\n")
        self.compile("lbm/a.cpp", "lbm/b.cpp", "lbm/c.cpp")
        self.assert_one(self.faults(), "lbm/b.cpp", "bugprone-branch-clone")

    def test_a_helper_that_nobody_calls_is_found_among_others(self):
        self.write("lbm/a.cpp", "namespace {\nint helper(int x) { return x + 1; }\n}\n")
        self.write("lbm/b.cpp", "int d() { return 1; }\n")
        self.compile("lbm/a.cpp", "lbm/b.cpp")
        self.assert_one(self.faults(), "lbm/a.cpp", "unused-function")

    def test_build_without_our_files_is_a_fault(self):
        self.write("lbm/a.cpp", "int x = 1;\n")
        self.compile()
        self.assert_one(self.faults(), "none of our sources")


class Readme(SmallTree):
    STEPS = ["puffin geometry x", "puffin voxelize x", "puffin check x", "puffin run x --out out", "puffin report out"]

    def faults(self, program: str) -> list[str]:
        commands = "\n".join("build/release/" + step for step in self.STEPS)
        self.write("README.md", f"```toml\nschema = 1\n```\n```bash\n{commands}\n```\n")
        self.write("puffin", "#!/bin/sh\n" + program)
        (self.root / "puffin").chmod(0o755)
        return check_readme.check(self.root, str(self.root / "puffin"))

    def test_failing_step_is_named(self):
        self.assert_one(self.faults('test "$1" != check || exit 3\n'), "puffin check x: exit 3")

    def test_steps_that_leave_no_report_are_a_fault(self):
        self.assert_one(self.faults("exit 0\n"), "no report.html")

    def test_steps_that_leave_a_report_are_in_order(self):
        self.assertEqual(self.faults("mkdir -p out && touch out/report.html\n"), [])


class Tutorials(SmallTree):
    def faults(self, page: str) -> list[str]:
        self.write("docs/tutorials/a.md", page)
        self.write("puffin", "#!/bin/sh\ntest -f $1 && echo read $1 and 7 more\n")
        (self.root / "puffin").chmod(0o755)
        return check_tutorials.check(self.root, str(self.root / "puffin"))

    def test_failing_command_is_named(self):
        self.assert_one(self.faults("```toml a.toml\nx = 1\n```\n```bash\npuffin b.toml\n```\n"), "puffin b.toml: exit 1")

    def test_other_words_than_promised_are_a_fault(self):
        page = "```toml a.toml\nx = 1\n```\n```bash\npuffin a.toml\n```\n```text\nread a.toml ... less\n```\n"
        self.assert_one(self.faults(page), "expected 'read a.toml ... less'")

    def test_page_without_commands_is_a_fault(self):
        self.assert_one(self.faults("Nothing to do.\n"), "no commands")

    def test_good_page_is_in_order(self):
        page = "```toml a.toml\nx = 1\n```\n```bash\npuffin a.toml\n```\n```text\nread a.toml ... more\n```\n"
        self.assertEqual(self.faults(page), [])


if __name__ == "__main__":
    unittest.main(verbosity=1)
