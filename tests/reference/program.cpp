#include "tests/reference/program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ostream>

#include "core/model/errors.h"
#include "core/storage/atomic_file.h"
#include "tests/reference/runner.h"

namespace limber::reference {
namespace {

struct Options {
  std::string cases;
  std::string results;
};

void describe(CLI::App& app, Options& options) {
  app.add_option("CASES", options.cases, "reference cases, JSON")->required()->type_name("");
  app.add_option("-o,--output", options.results, "where the results go, JSON")
      ->required()
      ->type_name("RESULTS");
}

InputError as_input_error(const CLI::ParseError& error) {
  std::string what = error.what();
  std::replace(what.begin(), what.end(), '\n', ' ');
  return InputError({"command line", what, "give CASES.json -o RESULTS.json"});
}

nlohmann::json run_all(const std::vector<CaseRecord>& cases, std::ostream& err) {
  nlohmann::json results = nlohmann::json::object();
  for (const CaseRecord& record : cases) {
    const Outcome outcome = run_case(record);
    for (const std::string& reason : outcome.left_out) {
      err << fmt::format("left out {}: {}\n", record.id, reason);
    }
    if (!outcome.quantities.is_null()) results[record.id] = outcome.quantities;
  }
  return results;
}

int report(std::ostream& err, const Diagnostic& diagnostic, int exit_code) {
  err << "limber_reference: " << diagnostic.text() << '\n';
  return exit_code;
}

}  // namespace

int program(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  CLI::App app("Runs reference cases through the library and writes what it finds.",
               "limber_reference");
  Options options;
  describe(app, options);
  try {
    app.parse(argc, argv);
    const std::vector<CaseRecord> cases = read_cases(options.cases);
    require_writable(options.results);
    write_file_atomically(options.results, run_all(cases, err).dump(1) + "\n");
    return 0;
  } catch (const CLI::CallForHelp&) {
    out << app.help();
    return 0;
  } catch (const CLI::ParseError& error) {
    return report(err, as_input_error(error).diagnostic, 2);
  } catch (const InputError& error) {
    return report(err, error.diagnostic, 2);
  } catch (const std::exception& error) {
    return report(err, {"internal error", error.what(), "please report it with the file"}, 1);
  }
}

}  // namespace limber::reference
