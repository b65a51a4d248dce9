// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "views/overview_table.hpp"

#include <QWidget>

class QHBoxLayout;
class QStackedWidget;

namespace cortex::gui {

class TextLabel;

// A part of the first page: its title, how much there is, and rows, or a line that says why there
// are none.
class OverviewPart : public QWidget {
    Q_OBJECT
public:
    OverviewPart(const QString& title, std::vector<OverviewTable::Column> columns,
                 const QString& none, QWidget* parent = nullptr);

    OverviewTable& table() { return *table_; }
    void show(const OverviewRows& rows, const QString& count, const OverviewTable::Gone& gone = {});
    using QWidget::show;
    void addToTitle(QWidget& widget);  // at its end
    void addBelow(TextLabel& note);    // its lines have room, whatever it says
    void setLeastRows(int rows);
    bool hasHeightForWidth() const override { return false; }  // what it says gives it no size

private:
    TextLabel* count_;
    TextLabel* note_ = nullptr;
    QHBoxLayout *head_, *foot_;
    QStackedWidget* content_;
    OverviewTable* table_;
};

}  // namespace cortex::gui
