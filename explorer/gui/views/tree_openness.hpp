// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QJsonObject>
#include <map>
#include <string>

class QModelIndex;

namespace cortex::gui {

class SystemModel;
class TreeRows;

// Which rows of the tree are open: at first those of the first two levels, unless they are of an
// agent, in whatever order agents come; then as a person has opened and closed them, also while
// they are gone, while a filter opens all, and from start to start.
class TreeOpenness {
public:
    TreeOpenness(TreeRows& rows, const SystemModel& model);

    void showAll(bool all);  // for a filter; then as it was before
    QJsonObject saved() const;
    void restore(const QJsonObject& saved);

private:
    bool isOpenAtFirst(const QModelIndex& row) const;
    bool isOpen(const QModelIndex& row) const;
    void added(const QModelIndex& above, int first, int last);
    void apply(const QModelIndex& above, int first, int last);
    void applyToAll();
    void note(const QModelIndex& row, bool open);

    TreeRows& rows_;
    const SystemModel& model_;
    std::map<std::string, bool> noted_;  // what differs from how it is at first, by path
    bool all_ = false, applies_ = false;
};

}  // namespace cortex::gui
