// SPDX-License-Identifier: Apache-2.0
// Views that the tests of the window load.
#include "cortex/explorer/view.hpp"

#include <QLabel>
#include <stdexcept>

using namespace cortex::explorer;

namespace {

// Says what it knows, as text.
class SaysAll final : public View {
public:
    explicit SaysAll(std::string path) : path_{std::move(path)}, label_{new QLabel{this}} {
        label_->setObjectName("said");
    }
    void bind(const SystemNow& now) override {
        demands_ = now.at(path_).related("demand");
        controllers_ = now.at(demands_.at(0)).relatedBy("demands");
        devices_ = now.instances("AxisDevice");
    }
    void refresh(const SystemNow& now) override {
        const SimplexNow device = now.at(path_), axis = now.at(demands_.at(0));
        QStringList said{axis.text("position") + axis.unit("position"),
                         device.live() ? "live" : "not live",
                         device.state() ? name(*device.state()) : "no state"};
        said << QString::number(controllers_.size()) << QString::fromStdString(devices_.at(0));
        said << now.at("/nobody").text("position") << device.text("no such item");
        label_->setText(said.join('|'));
    }

private:
    std::string path_;
    QLabel* label_;
    std::vector<std::string> demands_, controllers_, devices_;
};

class Throws final : public View {
public:
    void refresh(const SystemNow& /*now*/) override { throw std::runtime_error{"out of paper"}; }
};

View* makeSaysAll(const std::string& path) { return new SaysAll{path}; }
View* makeThrows(const std::string& /*path*/) { return new Throws; }
View* makeNothing(const std::string& /*path*/) { return nullptr; }

}  // namespace

CORTEX_EXPLORER_PLUGIN({"says-all", "All", "AxisDevice", &makeSaysAll},
                       {"throws", "Paper", "HoldAxisController", &makeThrows},
                       {"nothing", "Nothing", "Active", &makeNothing})
