// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>
#include <QWidget>

class QBoxLayout;
class QMenu;
class QPushButton;

namespace cortex::gui {

class ControlBar;
class StopButton;
class TextLabel;

// The bar along the top: menu, find, title, control, Stop. Whatever is said of control, none of its
// buttons moves. What there is room for follows from its width; only words that are longer than
// usual take the place of Find, which stands in the menu, too.
class TopBar : public QWidget {
    Q_OBJECT
public:
    TopBar(ControlBar& control, StopButton& stop, QWidget* parent = nullptr);

    void setMenu(QMenu& menu);
    void setNarrow(bool narrow);
    QPushButton& menuButton() { return *menu_; }
    QPushButton& findButton() { return *find_; }

Q_SIGNALS:
    void findWanted();

protected:
    bool event(QEvent* event) override;

private:
    void fit();

    ControlBar& control_;
    StopButton& stop_;
    QBoxLayout* row_;
    QPushButton *menu_, *find_;
    TextLabel* title_;
    bool narrow_ = false;
};

}  // namespace cortex::gui
