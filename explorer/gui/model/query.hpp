// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/condition.hpp"
#include "session/frame.hpp"

#include <QString>
#include <QStringList>
#include <optional>
#include <string>
#include <vector>

namespace cortex::explorer {

// The words of a text; blanks between quotes do not part them.
QStringList queryWords(const QString& text);

// What is typed into a filter: words, "texts", field:value, conditions on values, flags; blank is
// `and`, `or` binds weaker, - is not. `is:Axis state:Active`, `position>1.5 in:/arm`,
// `agent:robot -quality:good`, `fault or lost`.
class Query {
public:
    Query() = default;  // matches everything
    explicit Query(const QString& text);

    bool empty() const { return alternatives_.empty(); }
    // What is wrong with it, with the nearest names; empty: nothing.
    const QString& trouble() const { return trouble_; }
    bool matches(const Frame& frame, Place place) const;

private:
    struct Term {
        QString field, value;                // an empty field: a part of path, type or description
        std::optional<Condition> condition;  // instead of both
        bool no = false;
    };
    static bool holds(const Term& term, const Frame& frame, Place place);
    void add(std::vector<Term>& terms, QString word);

    std::vector<std::vector<Term>> alternatives_;
    QString trouble_;
};

}  // namespace cortex::explorer
