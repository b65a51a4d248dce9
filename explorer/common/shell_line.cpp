// SPDX-License-Identifier: Apache-2.0
#include "common/shell_line.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace cortex::common {

std::string shellWord(const std::string& word) {
    const bool plain = !word.empty() && std::ranges::all_of(word, [](unsigned char c) {
        return std::isalnum(c) != 0 ||
               std::string_view{"/._-=+:,@%"}.find(static_cast<char>(c)) != std::string_view::npos;
    });
    if (plain) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string{"'\\''"} : std::string{c};
    return text + "'";
}

std::string shellLine(const std::vector<std::string>& words, const comms::NetworkOptions& network) {
    std::string text = "cortex";
    const auto add = [&](const std::string& option, const std::string& value) {
        text += ' ' + option + ' ' + shellWord(value);
    };
    for (const std::string& each : words) text += ' ' + shellWord(each);
    if (network.domain != 0) add("--domain", std::to_string(network.domain));
    for (const std::string& each : network.interfaces) add("--interface", each);
    for (const std::string& each : network.peers) add("--peer", each);
    if (!network.discoveryServer.empty()) add("--discovery-server", network.discoveryServer);
    if (!network.security.empty()) add("--security", network.security);
    return text;
}

}  // namespace cortex::common
