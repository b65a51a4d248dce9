// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>
#include <QWidget>

namespace cortex::gui {

class TextLabel;

// What a page says where it has nothing to show.
class EmptyPage : public QWidget {
    Q_OBJECT
public:
    explicit EmptyPage(QWidget* parent = nullptr);
    void show(const QString& title, const QString& text);
    using QWidget::show;

private:
    TextLabel *title_, *text_;
};

}  // namespace cortex::gui
