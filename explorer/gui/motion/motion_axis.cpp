// SPDX-License-Identifier: Apache-2.0
#include "motion/motion_axis.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <limits>

namespace cortex::explorer {

namespace {

constexpr double near = 1e-6;  // of the range; as close to a limit as nobody can see

QStringList partsOf(const std::string& path) {
    return QString::fromStdString(path).split('/', Qt::SkipEmptyParts);
}

// What axis and demand are called alike; otherwise what both lie below: /x/observed, /x/demanded.
QString nameOf(const std::string& axis, const std::string& demand) {
    const QStringList one = partsOf(axis), other = partsOf(demand);
    if (one.isEmpty()) return other.isEmpty() ? QString{} : other.last();
    QString name = one.last();
    if (!other.isEmpty() && other.last() != name) {
        int same = 0;
        while (same < std::min(one.size(), other.size()) && one[same] == other[same]) ++same;
        if (same > 0) name = one[same - 1];
    }
    bool isNumber = false;
    name.toInt(&isNumber);
    return isNumber ? QStringLiteral("A") + name : name;
}

// The lower one of the greatest velocity and the greatest change of the position.
std::optional<double> greatestSpeed(const SimplexNow& demand) {
    const double none = std::numeric_limits<double>::infinity();
    const double speed =
        std::min(demand.max("velocity").value_or(none), demand.rate("position").value_or(none));
    return std::isfinite(speed) && speed > 0 ? std::optional{speed} : std::nullopt;
}

std::string unitOf(const SimplexNow& simplex, std::string_view item) {
    const Type* type = simplex.type();
    const DataItem* data = type != nullptr ? type->findData(item) : nullptr;
    return data != nullptr ? data->unit : std::string{};
}

MotionAxis axisOf(const SystemNow& now, const std::string& axis, const std::string& demand) {
    const SimplexNow wished = now.at(demand);
    MotionAxis result;
    result.name = nameOf(axis, demand);
    result.axis = axis;
    result.demand = demand;
    result.device = now.deviceOf(demand).value_or("");
    result.positionUnit = unitOf(wished, "position");
    result.velocityUnit = unitOf(wished, "velocity");
    if (const Type* type = wished.type()) result.demandType = QString::fromStdString(type->name);
    result.min = wished.min("position");
    result.max = wished.max("position");
    result.most = greatestSpeed(wished);
    return result;
}

}  // namespace

bool MotionAxis::isAtLimit(int direction) const {
    const auto limit = direction > 0 ? max : min;
    if (!wished || !limit) return false;
    const double range = min && max ? *max - *min : std::max(1.0, std::abs(*limit));
    return (*limit - *wished) * direction <= near * range;
}

QString MotionAxis::limitText() const {
    if (isAtLimit(1)) return QCoreApplication::translate("Motion", "at its upper limit");
    if (isAtLimit(-1)) return QCoreApplication::translate("Motion", "at its lower limit");
    return {};
}

bool MotionAxis::isSame(const MotionAxis& other) const {
    return name == other.name && axis == other.axis && demand == other.demand &&
           device == other.device && positionUnit == other.positionUnit && min == other.min &&
           max == other.max && most == other.most;
}

void tellApart(std::vector<MotionAxis>& axes) {
    std::vector<QString> names;
    for (const MotionAxis& each : axes) {
        const auto endOf = [](const MotionAxis& axis, int count) {
            const QStringList parts = partsOf(axis.axis.empty() ? axis.demand : axis.axis);
            return parts.mid(static_cast<int>(parts.size()) - count).join('/');
        };
        const auto isShared = [&](const auto& nameOfOne) {
            return std::ranges::count_if(axes, [&](const MotionAxis& other) {
                       return nameOfOne(other) == nameOfOne(each);
                   }) > 1;
        };
        names.push_back(each.name);
        if (!isShared([](const MotionAxis& axis) { return axis.name; })) continue;
        int count = 2;
        const int all = static_cast<int>(partsOf(each.axis).size());
        while (count < all && isShared([&](const MotionAxis& axis) { return endOf(axis, count); }))
            ++count;
        names.back() = endOf(each, count);
    }
    for (std::size_t i = 0; i < axes.size(); ++i) axes[i].name = names[i];
}

std::vector<MotionAxis> axesOf(const SystemNow& now, const std::string& controller) {
    const SimplexNow simplex = now.at(controller);
    const auto axes = simplex.related("axes"), demands = simplex.related("demands");
    std::vector<MotionAxis> result;
    for (std::size_t i = 0; i < demands.size(); ++i) {
        result.push_back(axisOf(now, i < axes.size() ? axes[i] : std::string{}, demands[i]));
    }
    tellApart(result);
    return result;
}

void refresh(MotionAxis& axis, const SystemNow& now) {
    const SimplexNow observed = now.at(axis.axis), wished = now.at(axis.demand);
    axis.position = observed.number("position");
    axis.velocity = observed.number("velocity");
    axis.live = observed.live();
    axis.wished = wished.number("position");
    axis.demandLive = wished.live();
    axis.drive = axis.device.empty() ? std::nullopt : now.at(axis.device).state();
}

}  // namespace cortex::explorer
