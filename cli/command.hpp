#pragma once
#include <functional>
#include <string>

namespace CLI {
class App;
}

/// One function per command: it declares its options and sets `action`, which is called when the
/// command was chosen. An action returns the exit code or throws Error.
namespace flowslide::cli {

using Command = std::function<int()>;

void add_run(CLI::App& app, Command& action);
void add_check(CLI::App& app, Command& action);
void add_inspect(CLI::App& app, Command& action);
void add_convert(CLI::App& app, Command& action);
void add_plot(CLI::App& app, Command& action);
void add_point(CLI::App& app, Command& action);
void add_motion(CLI::App& app, Command& action);
void add_report(CLI::App& app, Command& action);
void add_study(CLI::App& app, Command& action);
void add_verify(CLI::App& app, Command& action);
void add_bench(CLI::App& app, Command& action);
void add_schema(CLI::App& app, Command& action);
void add_docs(CLI::App& app, Command& action);
void add_completion(CLI::App& app, Command& action);

}  // namespace flowslide::cli
