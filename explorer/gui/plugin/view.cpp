// SPDX-License-Identifier: Apache-2.0
#include "cortex/explorer/view.hpp"

#include "model/value_text.hpp"

#include <utility>

namespace cortex::explorer {

ShownUnit Host::shownUnit(const QWidget& /*asker*/, const std::string& unit) const {
    return {gui::unitText(unit)};
}

void Host::chooseUnit(QWidget& /*asker*/, const std::string& /*unit*/) {}

void View::bind(const SystemNow& /*now*/) {}

bool View::select(const std::string& /*path*/) { return false; }

void View::restore(const QJsonObject& /*saved*/) {}

QString View::whyNot(const std::string& path, const std::string& command) const {
    return host_ != nullptr ? host_->whyNot(path, command) : tr("the view is in no window");
}

void View::send(const Order& order, Host::Done done) {
    if (host_ != nullptr) {
        host_->send(*this, order, std::move(done));
    } else if (done) {
        done({false, tr("the view is in no window"), {}});
    }
}

Hold* View::hold(QWidget& button, const HeldOrder& order) {
    return host_ != nullptr ? host_->hold(button, order) : nullptr;
}

ShownUnit View::shownUnit(const std::string& unit) const {
    return host_ != nullptr ? host_->shownUnit(*this, unit) : ShownUnit{gui::unitText(unit)};
}

void View::chooseUnit(const std::string& unit) {
    if (host_ != nullptr) host_->chooseUnit(*this, unit);
}

}  // namespace cortex::explorer
