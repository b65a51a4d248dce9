// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/explorer/view.hpp"

#include <QStringList>

namespace cortex::gui {

using explorer::Plugin;
using explorer::SystemNow;
using explorer::View;
using explorer::ViewType;

// The views that shared objects offer.
class Plugins {
public:
    explicit Plugins(const QStringList& folders);  // loads what is in them
    // Those of the program, loaded at the first question: $CORTEX_EXPLORER_PLUGINS,
    // ~/.local/lib/cortex/explorer, and lib/cortex/explorer beside the program.
    static Plugins& all();
    // Views of the program itself. Those of shared objects for the same type go before them.
    void add(const Plugin& plugin);

    // The view of the most derived type that has one; of several parents the first. Null: none.
    const ViewType* viewFor(const Type& type, const TypeModel& types) const;
    std::vector<const ViewType*> ofSystem() const;  // that are for no type
    // What could not be loaded and why, a sentence each.
    const QStringList& problems() const { return problems_; }

private:
    void load(const QString& file);

    std::vector<const ViewType*> views_;
    QStringList problems_;
};

}  // namespace cortex::gui
