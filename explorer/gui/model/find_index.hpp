// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <QString>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cortex::gui {

enum class FoundKind : std::uint8_t { View, Action, Simplex, Command, Item };

// Something that can be opened.
struct Found {
    FoundKind kind = FoundKind::Simplex;
    std::string path;       // of the simplex; of a view: its kind; of an action: its number
    std::string name;       // of the item or command; of a view: its title; of an action: its text
    std::string type{};     // of the simplex, or what it is of; of an action: its keys
    bool discards = false;  // something that is there; such an action is found last
    // As it is looked for and shown: "/drives/4.position".
    std::string text() const;
};

// Everything that Ctrl+K finds, as of one frame.
class FindIndex {
public:
    explicit FindIndex(const Frame& frame);
    void add(Found found);

    // The best ones first. All words must be in the text or the type, in any order; upper and lower
    // case are alike. A word of a last name counts more than one of a path, and its begin more than
    // its middle. What discards comes last. No words: nothing.
    std::vector<const Found*> find(const QString& words, std::size_t most) const;
    std::size_t size() const { return all_.size(); }

private:
    struct Entry {
        Found found;
        std::string lower, last;  // of the text; its last name
    };
    std::vector<Entry> all_;
};

}  // namespace cortex::gui
