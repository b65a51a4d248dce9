// SPDX-License-Identifier: Apache-2.0
#include "views/overview_part.hpp"

#include "style/look.hpp"
#include "widgets/rows.hpp"
#include "widgets/text_label.hpp"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <utility>

namespace cortex::gui {

namespace {

constexpr int linesBelow = 2;

}  // namespace

OverviewPart::OverviewPart(const QString& title, std::vector<OverviewTable::Column> columns,
                           const QString& none, QWidget* parent)
    : QWidget{parent},
      count_{new TextLabel{TextSize::Text, false, &Tokens::ink2}},
      head_{new QHBoxLayout},
      foot_{new QHBoxLayout},
      content_{new QStackedWidget},
      table_{new OverviewTable{title, std::move(columns)}} {
    auto* name = new TextLabel{TextSize::Value, true};
    name->show(title);
    name->keepWhole();
    head_->addWidget(name);
    head_->addWidget(count_);
    head_->addStretch(1);
    auto* empty = new QWidget;
    auto* lines = new QVBoxLayout{empty};
    lines->setContentsMargins(Look::units(2), Look::units(1), Look::units(2), 0);
    auto* line = new TextLabel{TextSize::Text, false, &Tokens::ink2};
    line->show(none);
    lines->addWidget(line);
    lines->addStretch(1);
    content_->addWidget(empty);
    content_->addWidget(table_);
    auto* rows = new QVBoxLayout{this};
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(0);
    rows->addLayout(head_);
    rows->addWidget(content_, 1);
    rows->addLayout(foot_);
    setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);
}

void OverviewPart::addToTitle(QWidget& widget) { head_->addWidget(&widget); }

void OverviewPart::addBelow(TextLabel& note) {
    note_ = &note;
    note.setWordWrap(true);
    note.setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    note.setAlignment(Qt::AlignTop | Qt::AlignLeft);
    foot_->addWidget(&note);
}

void OverviewPart::setLeastRows(int rows) {
    for (QHBoxLayout* each : {head_, foot_})
        each->setContentsMargins(Look::units(2), 0, Look::units(2), 0);
    head_->setSpacing(Look::units(3));
    int least = Look::units(7) + table_->header()->sizeHint().height() + rows * gui::rowHeight();
    if (note_ != nullptr) {
        const int below = note_->heightOfLines(linesBelow);
        note_->setFixedHeight(below);
        least += below;
    }
    setMinimumHeight(least);
}

void OverviewPart::show(const OverviewRows& rows, const QString& count,
                        const OverviewTable::Gone& gone) {
    table_->show(rows, gone);
    count_->show(count);
    content_->setCurrentWidget(table_->topLevelItemCount() > 0 ? table_ : content_->widget(0));
}

}  // namespace cortex::gui
