// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cortex/explorer/view.hpp"

#include "session/commands.hpp"

#include <QPointer>
#include <string>
#include <vector>

namespace cortex::gui {

class HeldButton;

// What the window does for views: permission, control, confirmation, orders and their answers.
class ViewHost : public QObject, public explorer::Host {
    Q_OBJECT
public:
    explicit ViewHost(Commands& commands, QObject* parent = nullptr);

    QString whyNot(const std::string& path, const std::string& command) const override;
    void send(QWidget& asker, const explorer::Order& order, Done done) override;
    explorer::Hold* hold(QWidget& button, const explorer::HeldOrder& order) override;
    explorer::ShownUnit shownUnit(const QWidget& asker, const std::string& unit) const override;
    void chooseUnit(QWidget& asker, const std::string& unit) override;
    void refresh();  // takes in what the session has ended

Q_SIGNALS:
    void controlWanted(const std::string& prefix);  // for an order that was not sent

private:
    void offerControl(const Frame& frame, Place place, StateSet available);
    void ask(QWidget& asker, const explorer::Order& order, const Command& command, Done done);
    void sendNow(QWidget& asker, const explorer::Order& order, const Command* command, Done done);

    Commands& commands_;
    std::vector<QPointer<HeldButton>> held_;
};

}  // namespace cortex::gui
