// SPDX-License-Identifier: Apache-2.0
#include "core/mutation.hpp"

#include <algorithm>
#include <regex>
#include <stdexcept>

namespace cortex::test {
namespace {

std::size_t startOfLine(const std::string& text, int line) {
    std::size_t start = 0;
    for (int n = 1; n < line; ++n) start = text.find('\n', start) + 1;
    return start;
}

// Where the element on a line begins and where its opening tag ends (behind '>').
std::pair<std::size_t, std::size_t> tagAt(const std::string& text, int line) {
    const std::size_t begin = text.find('<', startOfLine(text, line));
    return {begin, text.find('>', begin) + 1};
}

std::string firstMatch(const std::string& text, const char* pattern) {
    std::smatch match;
    if (!std::regex_search(text, match, std::regex{pattern})) {
        throw std::runtime_error("the remedy prints no " + std::string{pattern} + ": " + text);
    }
    return match[1];
}

std::string allMatches(std::string text, const char* pattern) {
    std::string all;
    for (std::smatch match; std::regex_search(text, match, std::regex{pattern});) {
        all += "    " + match[1].str() + "\n";
        text = match.suffix();
    }
    return all;
}

// An element's opening tag with one attribute written anew.
std::string withAttribute(std::string tag, const std::string& attribute) {
    const std::string name = attribute.substr(0, attribute.find('='));
    const std::regex old{"\\s" + name + "=\"[^\"]*\""};
    if (std::regex_search(tag, old)) return std::regex_replace(tag, old, " " + attribute);
    const std::size_t end = tag.find_first_of(" \n/>", 1);
    return tag.insert(end, " " + attribute);
}

void writeAttribute(std::string& text, int line, const std::string& remedy) {
    const auto [begin, end] = tagAt(text, line);
    const std::string attribute = firstMatch(remedy, "write (\\w+=\"[^\"]*\")");
    text.replace(begin, end - begin, withAttribute(text.substr(begin, end - begin), attribute));
}

void insertInto(std::string& text, int line, const std::string& elements) {
    const auto [begin, end] = tagAt(text, line);
    if (text[end - 2] == '/')
        text.replace(end - 2, 2, ">\n" + elements + "  </simplex>");
    else
        text.insert(end, "\n" + elements);
}

// The wrong name is the last one in the message that stands on the line.
void writeNearest(std::string& text, int line, const Finding& finding) {
    const std::string right = firstMatch(finding.remedy, "nearest of: ([^,;]*)");
    const std::size_t start = startOfLine(text, line);
    const std::string here = text.substr(start, text.find('\n', start) - start);
    std::string wrong, message = finding.message;
    const std::regex name{"['<]([\\w./-]+)['>]"};
    for (std::smatch match; std::regex_search(message, match, name); message = match.suffix()) {
        if (here.find(match[1]) != std::string::npos) wrong = match[1];
    }
    if (wrong.empty()) throw std::runtime_error("no name of the message is on its line: " + here);
    text.replace(text.find(wrong, start), wrong.size(), right);
}

}  // namespace

std::ostream& operator<<(std::ostream& stream, const Mutation& mutation) {
    return stream << mutation.name;
}

std::string replaced(const std::string& text, std::string_view before, std::string_view after) {
    const std::size_t found = text.find(before);
    if (found == std::string::npos) {
        throw std::runtime_error("not in the file: " + std::string{before});
    }
    if (text.find(before, found + 1) != std::string::npos) {
        throw std::runtime_error("more than once in the file: " + std::string{before});
    }
    return std::string{text}.replace(found, before.size(), after);
}

void copyShipped(const ModelFolder& folder) {
    folder.copyOntology();
    folder.write(systemFile, caseStudy());
}

int lineOf(const std::string& text, std::string_view at, std::size_t changed, std::size_t length) {
    const std::size_t inChanged = text.substr(changed, length).rfind(at);
    const std::size_t found = inChanged != std::string::npos ? changed + inChanged : text.find(at);
    if (found == std::string::npos) return 0;
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(found);
    return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
}

void applyRemedy(const ModelFolder& folder, const Finding& finding, Remedy remedy) {
    std::string file = finding.place.file;
    int line = finding.place.line;
    if (remedy == Remedy::AttributeAt) {
        file = firstMatch(finding.remedy, "\\(([^():]+):\\d+\\)");
        line = std::stoi(firstMatch(finding.remedy, "\\([^():]+:(\\d+)\\)"));
    }
    const std::string name = std::filesystem::path{file}.filename().string();
    std::string text = folder.read(name);
    const auto [begin, end] = tagAt(text, line);
    switch (remedy) {
        case Remedy::None:
            break;
        case Remedy::Replace:
            text.replace(begin, end - begin, firstMatch(finding.remedy, "write (<[^>]*>)"));
            break;
        case Remedy::Insert:
            insertInto(text, line, allMatches(finding.remedy, "(<relate [^>]*>)"));
            break;
        case Remedy::Add:
            insertInto(text, line, allMatches(finding.remedy, "(<relate [^>]*>)"));
            text.insert(text.find("</system>"), allMatches(finding.remedy, "(<simplex [^>]*>)"));
            break;
        case Remedy::Remove:
            text.erase(begin, end - begin);
            break;
        case Remedy::Attribute:
        case Remedy::AttributeAt:
            writeAttribute(text, line, finding.remedy);
            break;
        case Remedy::Nearest:
            writeNearest(text, line, finding);
            break;
    }
    folder.write(name, text);
}

}  // namespace cortex::test
