// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/comms/mirror.hpp"

#include <QString>
#include <vector>

namespace cortex::gui {

// What is typed into the filter of events, in the grammar of the tree's: words, "texts" and
// field:value; blank is `and`, `or` binds weaker, - is not. `in:/arm severity:warning`,
// `limit or fault`, `-in:/tracking kind:"state change"`.
class EventQuery {
public:
    EventQuery() = default;  // matches everything
    explicit EventQuery(const QString& text);

    bool empty() const { return alternatives_.empty(); }
    const QString& text() const { return text_; }
    // What is wrong with it, with the nearest names; empty: nothing.
    const QString& trouble() const { return trouble_; }
    bool matches(const comms::AgentEvent& event) const;
    bool namesJogs() const;  // `kind:command` or `jog` is among its words

private:
    struct Term {
        QString field, value;  // an empty field: a part of path, text, agent or kind
        bool no = false;
    };
    Term termFrom(QString word);
    static bool holds(const Term& term, const comms::AgentEvent& event);

    QString text_;
    std::vector<std::vector<Term>> alternatives_;
    QString trouble_;
};

}  // namespace cortex::gui
