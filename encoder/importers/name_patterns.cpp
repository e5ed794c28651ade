#include "encoder/importers/name_patterns.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace tvg::cli {

namespace {

constexpr std::size_t kMostDigits = 18;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// The digits that start at `begin`, without leading zeros.
std::string_view digits_at(std::string_view name, std::size_t begin, std::size_t& end) {
  end = begin;
  while (end < name.size() && is_digit(name[end])) ++end;
  while (begin + 1 < end && name[begin] == '0') ++begin;
  return name.substr(begin, end - begin);
}

/// A name taken apart at one of its numbers.
struct Split {
  std::string prefix;
  std::string suffix;
  std::int64_t number = 0;
  std::size_t digits = 0;
  bool leading_zero = false;
  int rank = 0;  ///< of two patterns with as many names, which is meant: the higher
};

/// Every way to take a name apart: at each of its last numbers, each with and without a sign.
std::vector<Split> splits(const std::string& name) {
  constexpr int kMostNumbers = 8;
  std::vector<Split> result;
  std::size_t end = name.size();
  for (int rank = 2 * kMostNumbers; rank > 0; rank -= 2) {
    while (end > 0 && !is_digit(name[end - 1])) --end;
    if (end == 0) break;
    std::size_t begin = end;
    while (begin > 0 && is_digit(name[begin - 1])) --begin;
    if (end - begin <= kMostDigits) {
      Split split{name.substr(0, begin),
                  name.substr(end),
                  0,
                  end - begin,
                  name[begin] == '0' && end - begin > 1,
                  rank};
      std::from_chars(name.data() + begin, name.data() + end, split.number);
      result.push_back(split);
      if (begin > 0 && name[begin - 1] == '-') {
        split.prefix.pop_back();
        split.number = -split.number;
        const bool separated = split.prefix.empty() ||
                               std::string_view("_. -/").find(split.prefix.back()) != std::string_view::npos;
        split.rank += separated ? 1 : -1;
        result.push_back(std::move(split));
      }
    }
    end = begin;
  }
  return result;
}

}  // namespace

NamePattern common_pattern(const std::vector<std::string>& names) {
  struct Group {
    std::vector<std::pair<std::size_t, Split>> members;  // index of the name
  };
  std::map<std::pair<std::string, std::string>, Group> groups;
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (Split& split : splits(names[i]))
      groups[{split.prefix, split.suffix}].members.emplace_back(i, std::move(split));
  }
  const Group* best = nullptr;
  const auto better = [](const Group& a, const Group& b) {
    if (a.members.size() != b.members.size()) return a.members.size() > b.members.size();
    return a.members[0].second.rank > b.members[0].second.rank;
  };
  for (const auto& [key, group] : groups) {
    if (best == nullptr || better(group, *best)) best = &group;
  }
  NamePattern result;
  if (best == nullptr) {
    if (!names.empty()) {
      result.pattern.prefix = names[0];
      result.files = {{0, names[0]}};
    }
    return result;
  }
  std::size_t width = 0;
  for (const auto& [index, split] : best->members) {
    result.files.push_back({split.number, names[index]});
    if (split.leading_zero && (width == 0 || split.digits < width)) width = split.digits;
  }
  result.pattern = {"", best->members[0].second.prefix, best->members[0].second.suffix, width};
  std::sort(result.files.begin(), result.files.end(),
            [](const NumberedFile& a, const NumberedFile& b) { return a.number < b.number; });
  return result;
}

std::vector<std::string> names_without(const std::vector<std::string>& names, const NamePattern& pattern) {
  std::set<std::string> known;
  for (const NumberedFile& file : pattern.files) known.insert(file.path);
  std::vector<std::string> others;
  std::copy_if(names.begin(), names.end(), std::back_inserter(others),
               [&](const std::string& name) { return !known.contains(name); });
  return others;
}

bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t k = 0;
  while (i < a.size() && k < b.size()) {
    if (is_digit(a[i]) && is_digit(b[k])) {
      const std::string_view x = digits_at(a, i, i);
      const std::string_view y = digits_at(b, k, k);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a[i] != b[k]) return static_cast<unsigned char>(a[i]) < static_cast<unsigned char>(b[k]);
      ++i;
      ++k;
    }
  }
  if (a.size() - i != b.size() - k) return a.size() - i < b.size() - k;
  return a < b;
}

}  // namespace tvg::cli
