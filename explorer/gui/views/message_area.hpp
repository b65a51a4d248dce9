// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "style/look.hpp"

#include <QPointer>
#include <QString>
#include <QWidget>
#include <vector>

namespace cortex::gui {

class Link;
class Popover;
class TextLabel;

// Messages that come and go, in a place that is always as high, so that nothing below it moves.
// Those that have no room stand behind "2 more", which opens all of them, whole.
class MessageArea : public QWidget {
    Q_OBJECT
public:
    struct Message {
        QString text;
        QColor Tokens::* colour = &Tokens::ink2;
        bool strong = false;
        QString tip{};
        QString opens{};  // of the first one: what a press on it opens; empty: nothing
    };

    explicit MessageArea(QWidget* parent = nullptr);

    void show(std::vector<Message> messages);  // the most important one first; empty texts are none
    void setRoom(int lines, TextSize size);
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

Q_SIGNALS:
    void pressed();  // the first message, which opens something

protected:
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void place();
    int placeIn(int width);  // returns how many are not seen whole
    void openAll();

    int lines_ = 2;
    TextSize size_ = TextSize::Text;
    std::vector<Message> messages_;
    std::vector<TextLabel*> labels_;  // one for each message, and more that are hidden
    Link *more_, *press_;             // the one lies over the first message
    QPointer<Popover> all_;
};

}  // namespace cortex::gui
