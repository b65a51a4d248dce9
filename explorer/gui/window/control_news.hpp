// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <QString>
#include <QStringList>
#include <cstdint>
#include <set>
#include <string>

namespace cortex::gui {

// What the row below the bar says of control, and what its buttons would do: who asks for what is
// held here comes first, then whom this window asks, then what became of control last.
class ControlNews {
public:
    enum class Act { None, Take, Ask, Withdraw, Grant };
    struct Row {
        QString text, remedy, refusal;
        Act act = Act::None;  // of the remedy
        std::string prefix;   // to take or to ask for
        comms::LeaseClient::Asked asked{};
    };

    void refresh(const Frame& frame);
    const Row& row() const { return row_; }
    void close();  // the user has read it; a question of somebody else stays

private:
    struct Key {
        std::uint64_t told = 0;
        QString text;  // while it asks
        bool operator==(const Key&) const = default;
    };
    static Row question(const Control& control);
    static QString asking(const Frame& frame);
    Row notice(const Frame& frame);
    Row refusal(const Frame& frame);

    Row row_;
    Key key_, closed_;
    std::uint64_t told_ = 0;      // the notice that seen_ is about
    std::set<std::string> seen_;  // agents that refused, and showed since then that others hold it
};

}  // namespace cortex::gui
