// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "style/look.hpp"

#include <QAbstractButton>

namespace cortex::gui {

// A text in the colour of links that is pressed, by pointer or by key.
class Link : public QAbstractButton {
    Q_OBJECT
public:
    explicit Link(const QString& text, QWidget* parent = nullptr)
        : Link{text, TextSize::Text, parent} {}
    Link(const QString& text, TextSize size, QWidget* parent = nullptr);
    QSize sizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;  // Enter, besides the blank

private:
    TextSize size_;
};

}  // namespace cortex::gui
