// SPDX-License-Identifier: Apache-2.0
#include "views/own_view.hpp"

#include "session/frame.hpp"
#include "widgets/text_label.hpp"

#include <QVBoxLayout>
#include <exception>
#include <stdexcept>

namespace cortex::gui {

OwnView::OwnView(explorer::Host& host, QWidget* parent)
    : QStackedWidget{parent},
      host_{host},
      title_{new TextLabel{TextSize::Empty}},
      text_{new TextLabel{TextSize::Text, false, &Tokens::ink2}} {
    auto* empty = new QWidget;
    auto* lines = new QVBoxLayout{empty};
    lines->addStretch(1);
    for (TextLabel* label : {title_, text_}) {
        label->setAlignment(Qt::AlignCenter);
        lines->addWidget(label);
    }
    lines->addStretch(2);
    addWidget(empty);
}

void OwnView::show(const ViewType& type, const std::string& path) {
    if (&type == type_ && path == path_) return;
    clear();
    type_ = &type;
    path_ = path;
    guarded([this] {
        view_ = type_->make(path_);
        if (view_ == nullptr) throw std::runtime_error{"there is no view"};
    });
    if (view_ == nullptr) return;
    view_->setHost(&host_);
    connect(view_, &View::opened, this, &OwnView::opened);
    connect(view_, &View::selected, this, &OwnView::selected);
    addWidget(view_);
    setCurrentWidget(view_);
}

void OwnView::clear() {
    delete view_;
    view_ = nullptr;
    type_ = nullptr;
    path_.clear();
    watches_.clear();
    bound_ = 0;
}

void OwnView::refresh(const Frame& frame) {
    if (view_ == nullptr || !isVisible()) return;
    const SystemNow now{frame};
    if (bound_ != frame.structures) {
        guarded([&] {
            view_->bind(now);
            watches_ = view_->watches();
        });
    }
    bound_ = frame.structures;
    if (view_ != nullptr) guarded([&] { view_->refresh(now); });
}

bool OwnView::select(const std::string& path) {
    bool shows = false;
    if (view_ != nullptr) guarded([&] { shows = view_->select(path); });
    return shows;
}

bool OwnView::settled() {
    bool settled = true;
    if (view_ != nullptr && isVisible()) guarded([&] { settled = view_->settled(); });
    return settled;
}

bool OwnView::wantsRoom() const {
    return view_ != nullptr && view_->property("cortexRoom").toBool();
}

QJsonObject OwnView::saved() {
    QJsonObject saved;
    if (view_ != nullptr) guarded([&] { saved = view_->saved(); });
    return saved;
}

void OwnView::restore(const QJsonObject& saved) {
    if (view_ != nullptr) guarded([&] { view_->restore(saved); });
}

void OwnView::guarded(const std::function<void()>& call) {
    try {
        call();
    } catch (const std::exception& error) {
        close(tr("it threw “%1”").arg(QString::fromUtf8(error.what())));
    } catch (...) {
        close(tr("it threw something that says nothing"));
    }
}

void OwnView::close(const QString& why) {
    if (view_ != nullptr) view_->deleteLater();
    view_ = nullptr;
    setCurrentIndex(0);
    title_->show(tr("View “%1” was closed: %2.").arg(QLatin1String{type_->name}, why));
    text_->show(tr("The other tabs show the same simplex."));
}

}  // namespace cortex::gui
