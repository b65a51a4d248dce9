// SPDX-License-Identifier: Apache-2.0
#include "common/person_name.hpp"

#include "cortex/core/cell.hpp"
#include "cortex/core/error.hpp"
#include "cortex/core/printable.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

#include <pwd.h>
#include <unistd.h>

namespace cortex::common {
namespace {

constexpr std::size_t longest = 63;

// Line and paragraph separators, marks of direction, and what is not seen at all.
constexpr std::array<std::string_view, 21> turning{
    "\u00ad", "\u200b", "\u200c", "\u200d", "\u2060", "\u3164", "\ufeff",
    "\u061c", "\u200e", "\u200f", "\u2028", "\u2029", "\u202a", "\u202b",
    "\u202c", "\u202d", "\u202e", "\u2066", "\u2067", "\u2068", "\u2069"};
constexpr std::array<std::string_view, 21> escapes{
    "\\u00ad", "\\u200b", "\\u200c", "\\u200d", "\\u2060", "\\u3164", "\\ufeff",
    "\\u061c", "\\u200e", "\\u200f", "\\u2028", "\\u2029", "\\u202a", "\\u202b",
    "\\u202c", "\\u202d", "\\u202e", "\\u2066", "\\u2067", "\\u2068", "\\u2069"};

std::string user() {
    constexpr std::size_t enough = 16384;
    std::vector<char> texts(enough);
    passwd entry{}, *found = nullptr;
    if (getpwuid_r(geteuid(), &entry, texts.data(), texts.size(), &found) == 0 &&
        found != nullptr && *found->pw_name != '\0')
        return found->pw_name;
    const char* told = std::getenv("USER");
    return told == nullptr || *told == '\0' ? "somebody" : told;
}

std::string userAtHost() {
    std::array<char, 256> host{};
    gethostname(host.data(), host.size() - 1);
    std::string name = user() + "@" + host.data();
    name.resize(fittingLength(name, longest));
    return comms::isPersonName(name) ? name : "somebody";
}

}  // namespace

std::string personName(const std::string& given) {
    if (given.empty()) return userAtHost();
    if (comms::isPersonName(given)) return given;
    throw Error{
        "a name of a person is a text of at most 63 bytes, in UTF-8, without control characters, "
        "brackets ( ) and blanks at its ends" +
        (given.size() > longest ? " (this has " + std::to_string(given.size()) + " bytes)" : "") +
        "; give another one (--name NAME)"};
}

std::string nameInCommand(const std::string& person) {
    if (person.size() <= longestInCommand) return person;
    const std::size_t at = person.find('@');
    const bool fits = at > 0 && at <= longestInCommand;  // npos does not
    std::string name = person.substr(0, fits ? at : fittingLength(person, longestInCommand));
    while (name.ends_with(' ')) name.pop_back();
    return name;
}

std::string shownName(const std::string& name) {
    std::string shown = printable(name);
    for (std::size_t i = 0; i < turning.size(); ++i) {
        for (std::size_t at = 0; (at = shown.find(turning[i], at)) != std::string::npos;)
            shown.replace(at, turning[i].size(), escapes[i]);
    }
    return shown;
}

std::string whoText(const std::string& name, const std::string& person) {
    return shownName(comms::whoText(name, person));
}

std::string personOf(const std::vector<comms::ToolStatus>& tools, const std::string& holder) {
    const auto found = std::ranges::find(tools, holder, &comms::ToolStatus::name);
    return found == tools.end() ? "" : found->person;
}

}  // namespace cortex::common
