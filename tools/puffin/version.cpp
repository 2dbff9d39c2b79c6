// puffin version

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "lbm/kernel.hpp"
#include "tools/puffin/build_info.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"

namespace puffin::tools {

namespace commands {
Command version() {
  return {"version", "what this program is", [](CLI::App& app) -> Action {
            auto json = std::make_shared<bool>(false);
            app.add_flag("--json", *json, "one JSON object on stdout");
            return [json] {
              const BuildInfo b = build_info();
              if (*json)
                print(nlohmann::json{{"name", "puffin"},
                                     {"version", b.version},
                                     {"commit", b.commit},
                                     {"compiler", b.compiler},
                                     {"build", b.type}}
                          .dump(2));
              else
                print("puffin " + b.version + " (" + b.commit + "; " + b.compiler + ", " + b.type + ")");
              return 0;
            };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
