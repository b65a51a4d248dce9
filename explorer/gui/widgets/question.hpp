// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "widgets/popover.hpp"

#include <QPointer>
#include <QStringList>

class QPushButton;

namespace cortex::gui {

class TextLabel;

// Asks a person before something is done. The button that does nothing has the keyboard, so that
// Enter does not do it; Esc and a click beside it do nothing either. All texts are plain.
class Question : public Popover {
    Q_OBJECT
public:
    struct Words {
        QString title;
        QStringList lines;  // below it, a paragraph each; many of them scroll
        QString yes, no;    // on the buttons
    };

    // It goes with its asker, also when that is not shown any more.
    Question(const Words& words, QWidget* asker);

    void refuse(const QString& why);  // why it cannot be done now; empty: it can
    QPushButton& yes() { return *yes_; }
    QPushButton& no() { return *no_; }

Q_SIGNALS:
    void pressed();  // yes; whoever hears it refuses or closes it

protected:
    bool eventFilter(QObject* object, QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    QWidget* asker_;
    QPushButton *yes_, *no_;
    TextLabel* reason_;
};

}  // namespace cortex::gui
