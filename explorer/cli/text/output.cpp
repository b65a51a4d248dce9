// SPDX-License-Identifier: Apache-2.0
#include "text/output.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include <unistd.h>

namespace cortex::cli {
namespace {

constexpr const char* plain = "\033[0m";

const char* colourOf(Severity severity) {
    constexpr std::array colours{"\033[36m", "\033[33m", "\033[31m"};
    return colours[static_cast<std::size_t>(severity)];
}

}  // namespace

bool coloured(Stream stream) {
    const char* none = std::getenv("NO_COLOR");
    if (none != nullptr && *none != '\0') return false;
    const char* terminal = std::getenv("TERM");
    if (terminal == nullptr || std::string_view{terminal} == "dumb") return false;
    return isatty(stream == Stream::Output ? STDOUT_FILENO : STDERR_FILENO) == 1;
}

bool looksLikeFile(const std::string& argument) {
    std::error_code ignored;
    return argument.ends_with(".xml") || std::filesystem::is_regular_file(argument, ignored);
}

void Columns::print(std::ostream& stream) const {
    std::vector<std::size_t> widths;
    for (const Line& line : lines_) {
        if (line.note) continue;
        widths.resize(std::max(widths.size(), line.cells.size()));
        for (std::size_t i = 0; i < line.cells.size(); ++i) {
            widths[i] = std::max(widths[i], textWidth(printable(line.cells[i])));
        }
    }
    for (const Line& line : lines_) {
        std::string text(line.note ? indent_ + 4 : indent_, ' ');
        for (std::size_t i = 0; i < line.cells.size(); ++i) {
            const std::string cell = printable(line.cells[i]);
            text += cell;
            if (!line.note && widths[i] > 0) text.append(widths[i] - textWidth(cell) + 2, ' ');
        }
        text.erase(text.find_last_not_of(' ') + 1);
        stream << text << '\n';
    }
}

void print(const Json& json) {
    std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void printFindings(const Report& report, Stream stream) {
    std::ostream& out = stream == Stream::Output ? std::cout : std::cerr;
    const bool colour = coloured(stream);
    for (const Finding& finding : report.findings) {
        if (colour) out << colourOf(finding.severity);
        out << (finding.severity == Severity::Info ? "note" : name(finding.severity)) << ':';
        if (colour) out << plain;
        out << ' ' << printable(finding.text()) << " (" << printable(finding.rule) << ")\n";
    }
}

}  // namespace cortex::cli
