// puffin version

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "lbm/kernel.hpp"
#include "tools/puffin/commands.hpp"
#include "tools/puffin/console.hpp"

namespace puffin::tools {

namespace commands {
Command version() {
  return {"version", "what this program is", [](CLI::App& app) -> Action {
            auto json = std::make_shared<bool>(false);
            app.add_flag("--json", *json, "one JSON object on stdout");
            return [json] {
              if (*json)
                print(nlohmann::json{{"name", "puffin"},
                                     {"version", PUFFIN_VERSION},
                                     {"commit", PUFFIN_COMMIT},
                                     {"compiler", PUFFIN_COMPILER},
                                     {"build", PUFFIN_BUILD_TYPE}}
                          .dump(2));
              else
                print("puffin " PUFFIN_VERSION " (" PUFFIN_COMMIT "; " PUFFIN_COMPILER ", " PUFFIN_BUILD_TYPE ")");
              return 0;
            };
          }};
}
}  // namespace commands

}  // namespace puffin::tools
