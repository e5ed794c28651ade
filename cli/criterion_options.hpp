#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tvg/measure.hpp>

namespace tvg::cli {

/// An option of the measure that matters to some criteria only.
struct CriterionOption {
  const char* name;                        ///< "--alpha"
  std::vector<std::string_view> criteria;  ///< those that look at it
  const char* type;                        ///< what --help calls its value
  std::string help;
  /// Puts what was typed where the criterion finds it. Throws ToolError.
  void (*set)(const std::string& text, Importance& importance);
  const char* missing = nullptr;  ///< what to do about it where the criterion cannot be without it
};

/// All of them, as --help lists them. An option is added by its line here.
std::span<const CriterionOption> criterion_options();

}  // namespace tvg::cli
