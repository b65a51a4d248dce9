// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/explorer/view.hpp"

#include "session/session.hpp"

#include <QPoint>
#include <optional>

class QWidget;

namespace cortex::gui {

// An order that is repeated while its button is down. It watches the button and the program for
// all that ends it; what the session sees ends it by finish().
class HeldButton : public explorer::Hold {
    Q_OBJECT
public:
    // `whyNot`: why it does not begin at all; empty: it begins.
    HeldButton(Session& session, QWidget& button, const explorer::HeldOrder& order,
               const QString& whyNot);
    ~HeldButton() override;

    std::uint64_t number() const { return number_; }
    bool runs() const override { return why_.isEmpty(); }
    QString why() const override { return why_; }
    void change(const explorer::Arguments& arguments) override;
    void end() override;
    void finish(const QString& why);  // the session has ended it

protected:
    bool eventFilter(QObject* object, QEvent* event) override;

private:
    void stop(const QString& why);
    QString endOf(QObject* object, QEvent* event);
    QString endOfPlace(QObject* object, QEvent* event) const;
    QString endOfButton(QEvent* event);

    Session& session_;
    QWidget& button_;
    std::optional<QPoint> pointer_;  // on the screen, where it was last; none: a key holds it
    std::uint64_t number_ = 0;
    QString why_;
};

}  // namespace cortex::gui
