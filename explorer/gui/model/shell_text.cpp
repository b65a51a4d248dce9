// SPDX-License-Identifier: Apache-2.0
#include "model/shell_text.hpp"

#include "common/shell_line.hpp"

namespace cortex::gui {

namespace {

// A single string is taken whole; in an array each stands in quotes where it must.
std::string argumentText(const Value& value) {
    const auto* texts = std::get_if<std::vector<std::string>>(&value);
    return texts != nullptr && texts->size() == 1 ? texts->front() : toText(value);
}

}  // namespace

QString shellText(const comms::NetworkOptions& network, const char* verb, const std::string& path,
                  const std::string& command, const comms::Mirror::Arguments& arguments) {
    std::vector<std::string> words{verb, path};
    if (!command.empty()) words.push_back(command);
    for (const auto& [name, value] : arguments) words.push_back(name + '=' + argumentText(value));
    return QString::fromStdString(common::shellLine(words, network));
}

}  // namespace cortex::gui
