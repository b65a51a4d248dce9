// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/core/type_model.hpp"

#include <QTreeWidget>

namespace cortex::explorer {

// The commands of a type with their parameters: what they do, when they are available, what they
// take and give.
class CommandList : public QTreeWidget {
    Q_OBJECT
public:
    explicit CommandList(QWidget* parent = nullptr);
    void show(const Type& type);
};

}  // namespace cortex::explorer
