// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/findings.hpp"

#include "base/bounds.hpp"
#include "base/text.hpp"
#include "files/xml_element.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

namespace cortex {

namespace {

// Walks over the text once and stops at each '<' and '&' outside of comments and CDATA.
class Guard {
public:
    Guard(const std::string& file, std::string_view content, Report& report)
        : file_{file}, content_{content}, report_{report} {}

    bool run() {
        const bool fine = checkOctets() && walk();
        if (fine && elements_ > bounds::elements) {
            refuse(finding::xmlElements,
                   "has more than " + std::to_string(bounds::elements) + " elements",
                   "divide it into several files");
        }
        return ok_;
    }

private:
    bool checkOctets() {
        if (content_.starts_with("\xEF\xBB\xBF")) content_.remove_prefix(3);
        if (content_.find('\0') != std::string_view::npos || !isUtf8(content_)) {
            refuse(finding::xmlEncoding, "is not UTF-8", "save the file as UTF-8");
        }
        return ok_;
    }

    bool walk() {
        while (ok_ && at_ < content_.size()) {
            const std::size_t next = content_.find_first_of("<&", at_);
            if (next == std::string_view::npos) break;
            moveTo(next);
            if (content_[at_] == '&') {
                reference();
            } else {
                markup();
            }
        }
        return ok_;
    }

    void markup() {
        const std::string_view rest = content_.substr(at_);
        if (rest.starts_with("<!--")) {
            skipPast("-->");
        } else if (rest.starts_with("<![CDATA[")) {
            skipPast("]]>");
        } else if (rest.starts_with("<!")) {
            refuse(finding::xmlDoctype,
                   "has a DOCTYPE or another declaration, which is not accepted",
                   "remove it; the schemas in ontology/ say what a file may contain");
        } else if (rest.starts_with("<?")) {
            declaration(rest);
            skipPast("?>");
        } else {
            if (!rest.starts_with("</")) tag(rest);
            moveTo(at_ + 1);
        }
    }

    // The parser looks at all attributes for each of an element's attributes.
    void tag(std::string_view rest) {
        ++elements_;
        char quote = 0;
        std::size_t attributes = 0;
        for (const char c : rest.substr(1)) {
            if (quote == 0 && (c == '>' || c == '<')) return;
            if (c == quote) {
                quote = 0;
            } else if (quote == 0 && (c == '"' || c == '\'')) {
                quote = c;
                if (++attributes > bounds::attributes) break;
            } else if (c == '<') {
                refuse(finding::xmlSyntax, "has '<' in the value of an attribute", "write &lt;");
                return;
            }
        }
        if (attributes > bounds::attributes) {
            refuse(finding::xmlElements, "has an element with too many attributes",
                   "no element has more than 19");
        }
    }

    void declaration(std::string_view rest) {
        const std::string_view text = rest.substr(0, rest.find("?>"));
        const std::size_t key = text.find("encoding");
        if (key == std::string_view::npos) return;
        const std::size_t open = text.find_first_of("\"'", key);
        if (open == std::string_view::npos) return;
        std::string value{text.substr(open + 1, text.find(text[open], open + 1) - open - 1)};
        std::ranges::transform(value, value.begin(), [](char c) {
            return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        });
        if (value != "utf-8" && value != "us-ascii") {
            refuse(finding::xmlEncoding, "declares the encoding " + inQuotes(value),
                   "save the file as UTF-8 and write encoding=\"UTF-8\"");
        }
    }

    void reference() {
        constexpr std::size_t longest = 12;
        const std::string_view rest = content_.substr(at_ + 1, longest);
        const std::size_t end = rest.find(';');
        const std::string_view entity = rest.substr(0, std::min(end, rest.size()));
        if (end == std::string_view::npos || !known(entity)) {
            refuse(finding::xmlEntity,
                   "has the entity " + inQuotes("&" + std::string{entity.substr(0, 10)}) +
                       ", which is not accepted",
                   "write the text itself; & is written &amp; (there are lt, gt, amp, quot, apos "
                   "and numbers such as &#176;)");
        }
        moveTo(at_ + 1);
    }

    static bool known(std::string_view entity) {
        constexpr std::array<std::string_view, 5> names{"lt", "gt", "amp", "quot", "apos"};
        if (std::ranges::find(names, entity) != names.end()) return true;
        if (!entity.starts_with('#')) return false;
        entity.remove_prefix(1);
        const int base = entity.starts_with('x') ? 16 : 10;
        if (base == 16) entity.remove_prefix(1);
        std::uint32_t code = 0;
        const char* last = entity.data() + entity.size();
        const auto [stop, error] = std::from_chars(entity.data(), last, code, base);
        const bool space = code == 9 || code == 10 || code == 13;
        const bool surrogate = code >= 0xD800 && code < 0xE000;
        return error == std::errc{} && stop == last && (space || code >= 0x20) && !surrogate &&
               code <= 0x10FFFF;
    }

    void skipPast(std::string_view end) {
        const std::size_t found = content_.find(end, at_);
        moveTo(found == std::string_view::npos ? content_.size() : found + end.size());
    }

    void moveTo(std::size_t position) {
        const auto begin = content_.begin() + static_cast<std::ptrdiff_t>(at_);
        const auto end = content_.begin() + static_cast<std::ptrdiff_t>(position);
        line_ += static_cast<int>(std::count(begin, end, '\n'));
        at_ = position;
    }

    // The first one ends the walk: a bomb has thousands.
    void refuse(const char* rule, const std::string& message, const char* remedy) {
        ok_ = false;
        report_.error("", rule, {file_, line_}, "the file " + message, remedy);
    }

    const std::string& file_;
    std::string_view content_;
    Report& report_;
    std::size_t at_ = 0;
    std::size_t elements_ = 0;
    int line_ = 1;
    bool ok_ = true;
};

}  // namespace

bool guardXml(const std::string& file, std::string_view content, Report& report) {
    return Guard{file, content, report}.run();
}

}  // namespace cortex
