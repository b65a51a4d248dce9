// SPDX-License-Identifier: Apache-2.0
#include "drive/drive_axis.hpp"

#include "cortex/drives/ds402_words.hpp"

#include <QCoreApplication>
#include <algorithm>

namespace cortex::explorer {

namespace {

constexpr std::size_t mostAxes = 2;
constexpr std::array driveItems{"position", "velocity", "effort"};
constexpr double openLink = 2;

QString driveText(const char* text) { return QCoreApplication::translate("Drive", text); }

std::optional<int> wholeNumber(const SimplexNow& simplex, const char* item, std::size_t at = 0) {
    const auto number = simplex.number(item, at);
    return number ? std::optional{static_cast<int>(*number)} : std::nullopt;
}

Ds402State stateIn(const SimplexNow& simplex, const char* item, std::size_t at = 0) {
    const int number = wholeNumber(simplex, item, at).value_or(0);
    const bool known = number > 0 && number <= static_cast<int>(Ds402State::Fault);
    return known ? static_cast<Ds402State>(number) : Ds402State::Unknown;
}

bool isTrue(const SimplexNow& simplex, const char* item, std::size_t at = 0) {
    return simplex.text(item, at).contains(QLatin1String{"true"});  // also in brackets
}

std::string unitIn(const SimplexNow& simplex, std::string_view item) {
    const Type* type = simplex.type();
    const DataItem* data = type != nullptr ? type->findData(item) : nullptr;
    return data != nullptr ? data->unit : std::string{};
}

// The limits that the demand states, as a robot's types do; otherwise those of what comes next.
DriveNumber numberFor(const SystemNow& now, const DriveAxis& axis, const char* item) {
    DriveNumber number{item, {}, {}, {}, {}, {}};
    for (const std::string* path : {&axis.demand, &axis.setpoint, &axis.observation}) {
        const SimplexNow simplex = now.at(*path);
        if (number.unit.empty()) number.unit = unitIn(simplex, item);
        if (!number.min) number.min = simplex.min(item);
        if (!number.max) number.max = simplex.max(item);
    }
    return number;
}

// Why what the drive says is not known for certain.
QString troubleOf(const DriveAxis& axis, const SystemNow& now) {
    if (axis.observation.empty()) return driveText("no drive is related to this axis");
    const QString path = QString::fromStdString(axis.observation);
    const SimplexNow drive = now.at(axis.observation);
    if (!drive.present()) return driveText("%1 is not heard").arg(path);
    if (drive.live()) return {};
    const SimplexNow device = now.at(axis.device);
    const auto link = device.live() ? device.number("link") : std::nullopt;
    if (link && *link != openLink)
        return driveText("the link of %1 is not open").arg(QString::fromStdString(axis.device));
    return driveText("%1 is %2").arg(path, QLatin1String{name(drive.quality())});
}

QString errorIn(int code) {
    for (const drives::Ds402ErrorRow& row : drives::ds402Errors) {
        if (row.code == code)
            return QLatin1String{row.name.data(), static_cast<int>(row.name.size())};
    }
    return {};
}

// In the words of the processor, where they are of the same error.
void refreshError(DriveAxis& axis, const SimplexNow& drive, const SimplexNow& processor) {
    const auto at = static_cast<std::size_t>(axis.number - 1);
    const auto told = wholeNumber(processor, "errorCode", at);
    axis.errorCode = wholeNumber(drive, "errorCode").value_or(told.value_or(0));
    axis.error.clear();
    if (axis.errorCode == 0) return;
    if (told == axis.errorCode) axis.error = processor.text("errorText", at);
    if (axis.error.startsWith('[')) axis.error = axis.error.mid(1).chopped(1);
    if (axis.error.isEmpty() || axis.error == QStringLiteral("—"))
        axis.error = errorIn(axis.errorCode);
}

}  // namespace

bool DriveAxis::isSame(const DriveAxis& other) const {
    const auto same = [](const DriveNumber& one, const DriveNumber& two) {
        return one.unit == two.unit && one.min == two.min && one.max == two.max;
    };
    return number == other.number && observation == other.observation &&
           setpoint == other.setpoint && demand == other.demand && device == other.device &&
           homingNeeded == other.homingNeeded && linked == other.linked &&
           std::ranges::equal(numbers, other.numbers, same);
}

std::vector<DriveAxis> driveAxesOf(const SystemNow& now, const std::string& processor) {
    const SimplexNow simplex = now.at(processor);
    const auto observations = simplex.related("drives"), setpoints = simplex.related("setpoints"),
               demands = simplex.related("demands");
    const std::size_t most = std::max({observations.size(), setpoints.size(), std::size_t{1}});
    std::vector<DriveAxis> axes;
    for (std::size_t i = 0; i < std::min(most, mostAxes); ++i) {
        DriveAxis axis;
        axis.number = static_cast<int>(i) + 1;
        if (i < observations.size()) axis.observation = observations[i];
        if (i < setpoints.size()) axis.setpoint = setpoints[i];
        // Two drives of one joint have one demand.
        if (!demands.empty()) axis.demand = demands[std::min(i, demands.size() - 1)];
        for (const std::string& path : {axis.observation, axis.setpoint}) {
            if (axis.device.empty() && !path.empty()) axis.device = now.deviceOf(path).value_or("");
        }
        const QString needed = now.at(axis.observation).text("homingNeeded");
        axis.homingNeeded = needed != QLatin1String{"false"};
        const Type* device = now.at(axis.device).type();
        axis.linked = device != nullptr && device->isA("FieldbusDevice");
        for (std::size_t n = 0; n < driveItems.size(); ++n)
            axis.numbers[n] = numberFor(now, axis, driveItems[n]);
        axes.push_back(std::move(axis));
    }
    return axes;
}

// The drive itself is asked first: in Standby a processor writes nothing.
void refresh(DriveAxis& axis, const SystemNow& now, const std::string& processor) {
    const SimplexNow leads = now.at(processor), drive = now.at(axis.observation),
                     told = now.at(axis.setpoint);
    const auto at = static_cast<std::size_t>(axis.number - 1);
    axis.trouble = troubleOf(axis, now);
    axis.told = told.live();
    axis.state = drive.number("driveState") ? stateIn(drive, "driveState")
                                            : stateIn(leads, "driveState", at);
    axis.wanted = leads.state() ? stateIn(leads, "wanted", at) : Ds402State::Unknown;
    axis.statusWord = wholeNumber(drive, "statusWord");
    axis.controlWord = wholeNumber(told, "controlWord");
    axis.mode = wholeNumber(drive, "modeDisplay");
    if (!axis.mode) axis.mode = wholeNumber(leads, "mode", at);
    axis.wishedMode = wholeNumber(told, "mode");
    axis.homed = !axis.homingNeeded || isTrue(drive, "homed");
    refreshError(axis, drive, leads);
    axis.lastTransition = leads.text("lastTransition", at);
    axis.transitions = leads.text("transitionCount", at);
    axis.refused = leads.text("refusedCount", at);
    axis.quickStopOption = wholeNumber(leads, "quickStopOption", at).value_or(2);
    axis.homingMethod = wholeNumber(leads, "homingMethod", at).value_or(37);
    for (DriveNumber& each : axis.numbers) {
        each.now = drive.number(each.item);
        each.wished = told.number(each.item);
    }
}

}  // namespace cortex::explorer
