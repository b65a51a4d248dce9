// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/session.hpp"
#include "window/control_news.hpp"
#include "window/control_panel.hpp"
#include "window/hand_over_panel.hpp"

#include <QPointer>
#include <QWidget>

class QPushButton;

namespace cortex::gui {

class ControlNotice;
class TextLabel;

// Whether this window may command, and what: "Read-only; Stop works" with "Take control…", or "You
// control /arm since 12:05 UTC" with "Hand over…" and "Release". Of whom it does not control it,
// though they have something there, is said: "You control everything but robot"; and "Take again"
// is offered as long as that is possible. What became of control, and who asks for it, stands in a
// row of its own.
class ControlBar : public QWidget {
    Q_OBJECT
public:
    explicit ControlBar(Session& session, QWidget* parent = nullptr);

    // `path`: the simplex that is shown, which the scopes are made from.
    void refresh(const std::shared_ptr<const Frame>& frame, const std::string& path);
    void setNarrow(bool narrow);
    void setRoom(int room);                  // px; where it is short, "Only Stop works", or less
    void choose();                           // opens the popover
    void choose(const std::string& prefix);  // the same, with this path chosen
    void release();
    void chooseHandOver();  // opens the popover
    // What was held, was neither released nor handed over, and can be taken again; empty: nothing.
    std::string missing() const;
    void takeAgain();
    bool holds() const { return !prefix_.empty(); }
    const std::string& prefix() const { return prefix_; }
    QString text() const;
    QString heldText() const;  // "everything", "/lift and /drive"
    QPushButton& againButton() { return *again_; }
    ControlNotice& notice() { return *notice_; }  // its place is the window's matter
    ControlPanel* panel() { return panel_; }
    HandOverPanel* handOverPanel() { return handOverPanel_; }

Q_SIGNALS:
    void changed();   // what is held
    void declined();  // the popover was closed without taking

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    QString partText(const std::string& prefix) const;
    QString readOnlyText() const;
    QString askingText() const;
    QString sinceText() const;
    QString wholeText() const;
    void showButtons();
    void refreshNotice();
    void closeNotice();
    void take(const std::string& prefix);
    void ask(const std::string& prefix);
    void act();  // what the remedy of the notice says
    void refuse();

    Session& session_;
    std::shared_ptr<const Frame> frame_;
    std::string path_, prefix_;
    bool narrow_ = false, took_ = false;
    int room_ = 0;
    ControlNews news_;
    ControlNews::Row shown_;  // in the notice
    TextLabel* label_;
    QPushButton *again_, *handOver_, *button_;
    ControlNotice* notice_;
    QPointer<ControlPanel> panel_;
    QPointer<HandOverPanel> handOverPanel_;
};

}  // namespace cortex::gui
