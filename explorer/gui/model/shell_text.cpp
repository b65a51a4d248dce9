// SPDX-License-Identifier: Apache-2.0
#include "model/shell_text.hpp"

#include <algorithm>
#include <cctype>

namespace cortex::gui {

namespace {

// A word that the shell takes as it stands, otherwise within quotes.
std::string quoted(const std::string& word) {
    const bool plain = !word.empty() && std::ranges::all_of(word, [](unsigned char c) {
        return std::isalnum(c) != 0 ||
               std::string_view{"/._-=+:,@%"}.find(static_cast<char>(c)) != std::string_view::npos;
    });
    if (plain) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string{"'\\''"} : std::string{c};
    return text + "'";
}

// A single string is taken whole; in an array each stands in quotes where it must.
std::string argumentText(const Value& value) {
    const auto* texts = std::get_if<std::vector<std::string>>(&value);
    return texts != nullptr && texts->size() == 1 ? texts->front() : toText(value);
}

}  // namespace

QString shellText(const comms::NetworkOptions& network, const char* verb, const std::string& path,
                  const std::string& command, const comms::Mirror::Arguments& arguments) {
    std::string text = std::string{"cortex "} + verb + ' ' + quoted(path);
    if (!command.empty()) text += ' ' + quoted(command);
    for (const auto& [name, value] : arguments) {
        text += ' ' + quoted(name + '=' + argumentText(value));
    }
    if (network.domain != 0) {
        text += " --domain " + std::to_string(network.domain);
    }
    for (const std::string& each : network.interfaces) text += " --interface " + quoted(each);
    if (!network.security.empty()) text += " --security " + quoted(network.security);
    return QString::fromStdString(text);
}

}  // namespace cortex::gui
