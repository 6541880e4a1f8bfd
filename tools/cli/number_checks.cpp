#include "tools/cli/number_checks.h"

#include <cmath>

namespace shaolin {
namespace {

template <class Accept>
CLI::Validator finite_number(const std::string& what, Accept accept) {
  return CLI::Validator(
      [=](const std::string& text) {
        double value = 0;
        const bool is_fine = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && accept(value);
        return is_fine ? std::string() : "'" + text + "' is not a number " + what;
      },
      "");
}

}  // namespace

CLI::Validator is_positive() {
  return finite_number("above 0", [](double value) { return value > 0; });
}

CLI::Validator is_not_negative() {
  return finite_number("from 0 on", [](double value) { return value >= 0; });
}

void add_seed_option(CLI::App& app, std::uint64_t& seed) {
  app.add_option("--seed", seed, "Seed of the random numbers")->check(CLI::NonNegativeNumber)->capture_default_str();
}

}  // namespace shaolin
