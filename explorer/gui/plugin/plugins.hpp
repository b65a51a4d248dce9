// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/explorer/view.hpp"

#include <QStringList>

namespace cortex::explorer {

// The views that shared objects offer.
class Plugins {
public:
    explicit Plugins(const QStringList& folders);  // loads what is in them
    // Those of the program, loaded at the first question: $CORTEX_EXPLORER_PLUGINS,
    // ~/.local/lib/cortex/explorer, and lib/cortex/explorer beside the program.
    static Plugins& all();

    // The view of the most derived type that has one; of several parents the first. Null: none.
    const ViewType* viewFor(const Type& type, const TypeModel& types) const;
    // What could not be loaded and why, a sentence each.
    const QStringList& problems() const { return problems_; }

private:
    void load(const QString& file);

    std::vector<const ViewType*> views_;
    QStringList problems_;
};

}  // namespace cortex::explorer
