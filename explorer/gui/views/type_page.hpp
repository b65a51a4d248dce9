// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include <QTreeWidget>

namespace cortex::gui {

// A type as it is written: what it is, its items, commands and rules, and which ancestor each comes
// from.
class TypePage : public QTreeWidget {
    Q_OBJECT
public:
    explicit TypePage(QWidget* parent = nullptr);
    void show(const Type& type, const TypeModel& types);
};

}  // namespace cortex::gui
