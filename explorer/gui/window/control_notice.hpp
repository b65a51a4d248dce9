// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QElapsedTimer>
#include <QRect>
#include <QTimer>
#include <QWidget>
#include <initializer_list>
#include <tuple>
#include <vector>

class QPushButton;

namespace cortex::gui {

class TextLabel;

// What became of a stop or start, and what was asked, refused or lost, in amber, with a remedy. It
// lies over the window, below the bar along the top. There a place of two lines is kept free for
// it; what is longer, and all of it in a low window, lies over what is below. So nothing ever moves
// under the mouse. For a moment after it has come, and after a button has changed, the mouse still
// reaches what it lies over.
class ControlNotice : public QWidget {
    Q_OBJECT
public:
    explicit ControlNotice(QWidget* parent = nullptr);

    QWidget& place() { return *place_; }  // that is kept free, in a layout of the window
    // In this window, but not over these buttons at its left edge.
    void lieIn(QWidget& window, std::vector<QWidget*> left);

    // What became of a stop or start. `again`: what a button beside it says; empty: there is none.
    void tell(const QString& outcome, const QString& again = {});
    // Empty: nothing, and no button. `refusal`: what a button says in the place of Close.
    void show(const QString& text, const QString& remedy, const QString& refusal = {});
    QString text() const;
    QPushButton& againButton() { return *again_; }
    QPushButton& remedy() { return *remedy_; }
    QPushButton& refuse() { return *refuse_; }

Q_SIGNALS:
    void closed();         // the user has read it
    void outcomeClosed();  // the same, where something was told

protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    bool eventFilter(QObject* object, QEvent* event) override;

private:
    // Of both texts: beside one another; one above the other, with all buttons beside them; the
    // same, with the buttons of each beside it.
    enum class Form { Beside, Above, Apart };
    using Shown = std::tuple<QPushButton*, QString, QRect>;

    bool isEmpty() const;
    std::vector<Shown> buttons() const;  // that are seen
    void dismiss();
    void appear();
    int keptHeight() const;
    void fit();
    int placeButtons(std::initializer_list<QPushButton*> buttons, int right, int top);
    void cutRemedy(int most);
    int placeTexts(int width, bool low);
    int arrange(int width, Form form);

    QWidget* place_;
    std::vector<QWidget*> left_;
    TextLabel *told_, *text_;
    QPushButton *again_, *remedy_, *refuse_, *close_;
    std::vector<Shown> seen_;  // buttons, as they were when something was said
    QString offered_;          // the remedy
    QString read_;             // outcome that the user has closed
    QTimer fresh_;
    QElapsedTimer pressable_;  // since other buttons stood there
};

}  // namespace cortex::gui
