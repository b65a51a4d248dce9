// SPDX-License-Identifier: Apache-2.0
#include "window/control_notice.hpp"

#include "style/look.hpp"
#include "widgets/text_label.hpp"

#include <QHBoxLayout>
#include <QPainter>
#include <QPushButton>
#include <algorithm>
#include <initializer_list>

namespace cortex::gui {

ControlNotice::ControlNotice(QWidget* parent)
    : QWidget{parent},
      row_{new QHBoxLayout{this}},
      told_{new TextLabel{TextSize::Note, true}},
      text_{new TextLabel{TextSize::Note, true, &Tokens::warnText}},
      remedy_{new QPushButton},
      close_{new QPushButton{tr("Close")}} {
    row_->setContentsMargins(Look::units(4), 0, Look::units(2), 0);
    for (QWidget* each : std::initializer_list<QWidget*>{told_, text_, remedy_, close_}) {
        row_->addWidget(each);
        each->hide();
    }
    for (TextLabel* each : {told_, text_}) {
        each->setWordWrap(true);
        const auto across = each == told_ ? QSizePolicy::Fixed : QSizePolicy::Ignored;
        each->setSizePolicy(across, QSizePolicy::Ignored);
    }
    row_->setStretchFactor(text_, 1);
    for (QPushButton* each : {remedy_, close_}) each->setFocusPolicy(Qt::TabFocus);
    connect(close_, &QPushButton::clicked, this, &ControlNotice::closed);
    fit();
}

void ControlNotice::tell(const QString& outcome) {
    if (outcome == told_->text()) return;
    told_->show(outcome);
    told_->setVisible(!outcome.isEmpty());
    fit();
}

void ControlNotice::show(const QString& text, const QString& remedy) {
    if (text != text_->text()) update();
    text_->show(text);
    remedy_->setText(remedy);
    text_->setVisible(!text.isEmpty());
    close_->setVisible(!text.isEmpty());
    remedy_->setVisible(!text.isEmpty() && !remedy.isEmpty());
    fit();
}

QString ControlNotice::text() const { return text_->text(); }

// The buttons are low, so that the room that is kept is small. Where there are both texts, what
// became of the order has what it needs, at most half.
void ControlNotice::fit() {
    const QMargins margins = row_->contentsMargins();
    int room = width() - margins.left() - margins.right();
    for (QPushButton* each : {remedy_, close_}) {
        each->setFixedHeight(Look::units(6));
        if (!each->isHidden()) room -= each->sizeHint().width() + row_->spacing();
    }
    if (!told_->isHidden()) {
        const int needed = QFontMetrics{told_->font()}.horizontalAdvance(told_->text()) + 2;
        const int told = text_->isHidden() ? room : std::min(needed, room / 2);
        told_->setFixedWidth(std::max(told, 1));
        room -= told + row_->spacing();
    }
    int height = std::max(Look::units(7), text_->heightOfLines(2));
    if (!told_->isHidden()) height = std::max(height, told_->heightForWidth(told_->maximumWidth()));
    if (!text_->isHidden()) height = std::max(height, text_->heightForWidth(std::max(room, 1)));
    if (height != minimumHeight()) setFixedHeight(height);
    row_->activate();  // a request to lay it out is lost while it is laid out
}

void ControlNotice::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    fit();
}

void ControlNotice::paintEvent(QPaintEvent* /*event*/) {
    if (!text_->text().isEmpty()) QPainter{this}.fillRect(rect(), Look::colours().warnBg);
}

}  // namespace cortex::gui
