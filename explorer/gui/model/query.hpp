// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/condition.hpp"
#include "session/frame.hpp"

#include <QString>
#include <QStringList>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cortex::gui {

// The words of each alternative of a text: `or` parts alternatives, blanks part words unless they
// are between quotes. No alternative has no word.
std::vector<QStringList> alternativesOf(const QString& text);
// Whether the word says "not"; its - is taken away.
bool takeNot(QString& word);
// What is wrong with a field that nobody knows, with the nearest names.
QString unknownField(const QString& field, std::span<const char* const> known);

// What is typed into a filter: words, "texts", field:value, conditions on values, flags; blank is
// `and`, `or` binds weaker, - is not. `is:AxisConcept state:Active`, `position>1.5 in:/arm`,
// `agent:robot -quality:good`, `fault or lost`.
class Query {
public:
    Query() = default;  // matches everything
    explicit Query(const QString& text);

    bool empty() const { return alternatives_.empty(); }
    // What is wrong with it, with the nearest names; empty: nothing.
    const QString& trouble() const { return trouble_; }
    // The same, a type that no agent knows, and a unit that an item cannot be compared in.
    QString troubleIn(const Frame& frame) const;
    bool matches(const Frame& frame, Place place) const;

private:
    struct Term {
        QString field, value;                // an empty field: a part of path, type or description
        std::optional<Condition> condition;  // instead of both
        bool no = false;
    };
    static bool holds(const Term& term, const Frame& frame, Place place);
    Term termFrom(QString word);

    std::vector<std::vector<Term>> alternatives_;
    QString trouble_;
};

}  // namespace cortex::gui
