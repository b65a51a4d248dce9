// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/session.hpp"
#include "window/control_panel.hpp"
#include "window/hand_over_panel.hpp"

#include <QPointer>
#include <QWidget>

class QPushButton;

namespace cortex::explorer {

class TextLabel;

// Whether this window may command, and what: "Read-only" with "Take control…", or "You control /arm
// since 12:05" with "Hand over…" and "Release". What became of control stands in a row of its own,
// with "Take again" where it was handed over or lost.
class ControlBar : public QWidget {
    Q_OBJECT
public:
    explicit ControlBar(Session& session, QWidget* parent = nullptr);

    // `path`: the simplex that is shown, which the scopes are made from.
    void refresh(const std::shared_ptr<const Frame>& frame, const std::string& path);
    void setNarrow(bool narrow);
    void choose();  // opens the popover
    void release();
    void chooseHandOver();  // opens the popover
    void takeAgain();       // what was held last
    bool holds() const { return !prefix_.empty(); }
    const std::string& prefix() const { return prefix_; }
    QString text() const;
    QWidget* notice() { return notice_; }  // the row; its place is the window's matter
    QString noticeText() const;
    ControlPanel* panel() { return panel_; }
    HandOverPanel* handOverPanel() { return handOverPanel_; }
    QPushButton& takeAgainButton() { return *again_; }

Q_SIGNALS:
    void changed();  // what is held

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void makeNotice();
    void showBelow(QWidget& popover);

    Session& session_;
    std::shared_ptr<const Frame> frame_;
    std::string path_, prefix_;
    bool narrow_ = false;
    QString told_;  // the notice that was closed
    TextLabel* label_;
    QPushButton *handOver_, *button_;
    QWidget* notice_;
    TextLabel* noticeText_;
    QPushButton* again_;
    QPointer<ControlPanel> panel_;
    QPointer<HandOverPanel> handOverPanel_;
};

}  // namespace cortex::explorer
