// SPDX-License-Identifier: Apache-2.0
#include "views/message_area.hpp"

#include "widgets/link.hpp"
#include "widgets/popover.hpp"
#include "widgets/text_label.hpp"

#include <QEvent>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

namespace cortex::gui {

namespace {

constexpr double widestPopover = 110;  // units

bool isSame(const MessageArea::Message& one, const MessageArea::Message& other) {
    return one.text == other.text && one.colour == other.colour && one.strong == other.strong &&
           one.tip == other.tip && one.opens == other.opens;
}

}  // namespace

MessageArea::MessageArea(QWidget* parent)
    : QWidget{parent}, more_{new Link{{}, this}}, press_{new Link{{}, this}} {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    more_->hide();
    press_->hide();
    connect(press_, &QAbstractButton::clicked, this, &MessageArea::pressed);
    connect(more_, &QAbstractButton::clicked, this, &MessageArea::openAll);
}

QSize MessageArea::sizeHint() const {
    TextLabel line{size_};
    return {Look::units(20), line.heightOfLines(lines_)};
}

void MessageArea::setRoom(int lines, TextSize size) {
    if (lines == lines_ && size == size_) return;
    lines_ = lines;
    size_ = size;
    updateGeometry();
    place();
}

void MessageArea::show(std::vector<Message> messages) {
    std::erase_if(messages, [](const Message& each) { return each.text.isEmpty(); });
    if (std::ranges::equal(messages, messages_, isSame)) return;
    messages_ = std::move(messages);
    while (labels_.size() < messages_.size()) {
        labels_.push_back(new TextLabel{size_, false, &Tokens::ink2, this});
        labels_.back()->setWordWrap(true);
    }
    for (std::size_t i = 0; i < labels_.size(); ++i) {
        const Message each = i < messages_.size() ? messages_[i] : Message{};
        labels_[i]->show(each.text, each.colour);
        labels_[i]->setToolTip(each.tip);
    }
    place();
}

// The link stands at the end of the last line, and takes its width from all of them.
void MessageArea::place() {
    int left = placeIn(width());
    if (left > 0) {
        more_->setText(tr("%1 more").arg(left));
        more_->setAccessibleName(tr("%1 more messages").arg(left));
        more_->setFixedSize(more_->sizeHint().width(),
                            std::min(more_->sizeHint().height(), height()));
        left = placeIn(width() - more_->width() - Look::units(2));
        more_->setText(tr("%1 more").arg(left));
        more_->move(width() - more_->width(), height() - more_->height());
    }
    more_->setVisible(left > 0);
    const bool opens = !messages_.empty() && !messages_.front().opens.isEmpty();
    press_->setVisible(opens);
    if (!opens) return;
    const Message& first = messages_.front();
    QRect place = labels_.front()->geometry();  // no wider than the words
    const QString& words = first.text;
    const int width = labels_.front()->fontMetrics().horizontalAdvance(words) + Look::units(2);
    place.setWidth(std::min(place.width(), width));
    press_->setGeometry(place);
    press_->setAccessibleName(first.text + QStringLiteral(": ") + first.opens);
    press_->setToolTip(first.tip.isEmpty() ? first.opens : first.opens + '\n' + first.tip);
    press_->raise();
}

// A first one that is longer than everything is cut; of the others those that fit are shown.
int MessageArea::placeIn(int width) {
    int y = 0, missing = 0;
    for (std::size_t i = 0; i < labels_.size(); ++i) {
        TextLabel& label = *labels_[i];
        const bool isMessage = i < messages_.size();
        label.setTextSize(size_, isMessage && messages_[i].strong);
        const int needed = label.heightForWidth(std::max(width, 1));
        const bool fits = y + needed <= height();
        label.setVisible(isMessage && (i == 0 || fits));
        if (isMessage && !fits) ++missing;
        if (label.isHidden()) continue;
        label.setGeometry(0, y, width, std::min(needed, height() - y));
        y += needed;
    }
    return missing;
}

void MessageArea::openAll() {
    if (all_) return;
    all_ = new Popover{tr("What is said here"), this};
    for (const Message& each : messages_) {
        auto* label = new TextLabel{TextSize::Text, each.strong, each.colour};
        label->setWordWrap(true);
        label->show(each.text);
        const int width = std::min(Look::units(widestPopover), window()->width() * 3 / 4);
        label->setFixedSize(width, label->heightForWidth(width));
        label->setTextInteractionFlags(Qt::TextSelectableByMouse);
        all_->rows().addWidget(label);
    }
    all_->openBelow(*more_);
}

void MessageArea::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    place();
}

void MessageArea::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() != QEvent::StyleChange && event->type() != QEvent::ApplicationFontChange)
        return;
    updateGeometry();
    place();
}

}  // namespace cortex::gui
