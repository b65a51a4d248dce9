// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/frame.hpp"
#include "widgets/popover.hpp"

#include <QStringList>
#include <memory>
#include <string>

class QLabel;
class QLineEdit;
class QListWidget;
class QListWidgetItem;
class QPushButton;
class QStackedWidget;

namespace cortex::gui {

class TextLabel;

// To whom control of all that is held goes: a click on a window or shell that is there, or on
// somebody who holds a lease somewhere, hands over; so does any other name with the button. Nothing
// moves while it is open: who comes is added below, and who goes keeps the row, in grey.
class HandOverPanel : public Popover {
    Q_OBJECT
public:
    explicit HandOverPanel(const std::shared_ptr<const Frame>& frame, QWidget* parent = nullptr);

    void refresh(const std::shared_ptr<const Frame>& frame);  // with those who are there by now
    void focusFirst();  // the rows where there are some, otherwise the field
    QLineEdit& nameField() { return *name_; }
    QPushButton& handOverButton() { return *handOver_; }
    QListWidget& others() { return *others_; }
    QStringList offered() const;  // names of tools and agents, also of those who are gone
    QString whyNobody() const;    // is offered, and what to do; empty: somebody is

Q_SIGNALS:
    void chosen(const std::string& name);

protected:
    bool eventFilter(QObject* object, QEvent* event) override;

private:
    void decide();
    void give(const QString& name);
    void add(const QStringList& names);
    void showRow(QListWidgetItem& row, const Frame& frame, bool isThere);

    TextLabel* what_;
    QLabel* nobody_;
    QListWidget* others_;
    QStackedWidget* place_;  // of one of the two
    QLineEdit* name_;
    QPushButton* handOver_;
    bool holds_ = false, given_ = false;
};

}  // namespace cortex::gui
