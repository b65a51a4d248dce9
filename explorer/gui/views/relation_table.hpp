// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"

#include <QTreeWidget>
#include <string>

namespace cortex::explorer {

// The relationships of a simplex, and those of others to it.
class RelationTable : public QTreeWidget {
    Q_OBJECT
public:
    explicit RelationTable(QWidget* parent = nullptr);

    void show(const Frame& frame, Place place);
    void refresh(const Frame& frame, Place place);  // states and qualities of the targets
    int count() const { return count_; }            // of its own

Q_SIGNALS:
    void opened(const std::string& path);

private:
    int count_ = 0;
};

}  // namespace cortex::explorer
