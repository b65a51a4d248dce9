// SPDX-License-Identifier: Apache-2.0
#include "cortex/mechanics/tip_velocity.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace cortex::mechanics {

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, SerialChain::maxJoints>;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using Counted = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;

Rows countedRows(const SerialChain::Jacobian& jacobian, const Directions& directions) {
    Rows rows(count(directions), jacobian.cols());
    Eigen::Index next = 0;
    for (Eigen::Index i = 0; i < 6; ++i) {
        if (directions[static_cast<std::size_t>(i)]) rows.row(next++) = jacobian.row(i);
    }
    return rows;
}

Counted countedOf(const Twist& tip, const Directions& directions) {
    Counted counted(count(directions));
    Eigen::Index next = 0;
    for (Eigen::Index i = 0; i < 6; ++i) {
        if (directions[static_cast<std::size_t>(i)]) counted[next++] = tip[i];
    }
    return counted;
}

// Of JJ': its vectors are those of J on the left, its values the squares.
Eigen::SelfAdjointEigenSolver<Square> decomposed(const Rows& rows) {
    const Square normal = rows.lazyProduct(rows.transpose());
    return Eigen::SelfAdjointEigenSolver<Square>{normal};
}

}  // namespace

int count(const Directions& directions) {
    return static_cast<int>(std::ranges::count(directions, true));
}

TipVelocity jointVelocities(const SerialChain::Jacobian& jacobian, const Twist& tip,
                            const Directions& directions) {
    const Rows rows = countedRows(jacobian, directions);
    const auto parts = decomposed(rows);
    const Counted values = parts.eigenvalues().cwiseMax(0.0).cwiseSqrt();  // the smallest first
    const Counted asked = countedOf(tip, directions);
    const Counted along = parts.eigenvectors().transpose().lazyProduct(asked);
    Counted weights(values.size());
    TipVelocity result;
    result.counted = static_cast<int>(values.size());
    double lost = 0;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        const bool given = values[i] > lostBelow * values[values.size() - 1];
        weights[i] = given ? along[i] / (values[i] * values[i]) : 0.0;
        if (!given) lost = std::hypot(lost, along[i]);
        result.values[static_cast<std::size_t>(i)] = values[i];
    }
    result.manipulability = values.prod();
    const Counted combined = parts.eigenvectors().lazyProduct(weights);
    result.joints = rows.transpose().lazyProduct(combined);
    const double length = asked.norm(), speed = result.joints.norm();
    if (length > 0) result.lost = lost / length;
    for (Eigen::Index i = 0; speed > 0 && i < values.size(); ++i)
        result.needs[static_cast<std::size_t>(i)] = std::abs(weights[i]) * values[i] / speed;
    return result;
}

SerialChain::JointVector selfMotion(const SerialChain::Jacobian& jacobian,
                                    const Directions& directions,
                                    const SerialChain::JointVector& before) {
    const Eigen::Index joints = jacobian.cols();
    SerialChain::JointVector motion = SerialChain::JointVector::Zero(joints);
    if (joints <= count(directions)) return motion;
    const Rows rows = countedRows(jacobian, directions);
    const auto parts = decomposed(rows);
    constexpr double least = 1e-10;  // of a square: below, it is none
    const auto withoutTip =
        [&](const SerialChain::JointVector& velocities) -> SerialChain::JointVector {  // I − J⁺J
        const Counted tip = rows.lazyProduct(velocities);
        Counted along = parts.eigenvectors().transpose().lazyProduct(tip);
        for (Eigen::Index k = 0; k < along.size(); ++k) {
            const double square = parts.eigenvalues()[k];
            along[k] = square > least ? along[k] / square : 0.0;
        }
        const Counted weights = parts.eigenvectors().lazyProduct(along);
        return velocities - rows.transpose().lazyProduct(weights);
    };
    constexpr double alike = 0.5;  // of `before`: with less of it, another one is begun
    motion = withoutTip(before);
    if (motion.norm() > alike) return motion.normalized();
    for (Eigen::Index i = 0; i < joints; ++i) {
        const SerialChain::JointVector candidate =
            withoutTip(SerialChain::JointVector::Unit(joints, i));
        if (candidate.norm() > motion.norm()) motion = candidate;
    }
    motion.normalize();
    if (motion.dot(before) < 0) motion = -motion;
    return motion;
}

}  // namespace cortex::mechanics
