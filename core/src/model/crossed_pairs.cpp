// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/crossed_pairs.hpp"

#include "cortex/core/system_findings.hpp"

#include "model/remedies.hpp"
#include "model/resolved_relations.hpp"

#include <algorithm>
#include <set>
#include <unordered_map>

// Who writes a demand and who reads it must agree on what observes it. The one says so by
// `counterpart`: a controller, a processor of drives. The other says so by `sameCount`: a device,
// between demands and delayed outputs, or a processor, between demands and its own counterparts.
// What only one of them knows is no contradiction: a sensor elsewhere, a result in its place.
namespace cortex {
namespace {

constexpr std::size_t mostReaders = 100;  // of one demand, looked at

// Relationships under one rule, in order, and their places by path.
struct Row {
    std::vector<const Simplex::Relation*> relations;
    std::unordered_map<std::string_view, std::size_t> places;

    Row(const Simplex& owner, const Rule& rule) : relations{relationsFor(owner, rule)} {
        for (std::size_t n = 0; n < relations.size(); ++n) places.try_emplace(path(n), n);
    }
    const std::string& path(std::size_t place) const { return relations[place]->target; }
    std::size_t size() const { return relations.size(); }
    std::size_t find(std::string_view path) const {  // size() if it is not there
        const auto found = places.find(path);
        return found == places.end() ? size() : found->second;
    }
};

// What one simplex says: the n-th of the one observes what the n-th of the other demands.
struct Pairing {
    const Simplex* owner;
    Row observed, demanded;
};

struct Crossing {
    const Pairing &writer, &reader;
    std::size_t written, read;  // places of the demand with the one and the other
};

std::string text(const Row& row, std::size_t n) {
    const Simplex::Relation& relation = *row.relations[n];
    const std::string place = relation.place.text();
    return relation.target + " (rule '" + relation.rule + "'" +
           (place.empty() ? "" : ", " + place) + ")";
}

std::string line(const Row& row, std::size_t n) {
    const Simplex::Relation& relation = *row.relations[n];
    const std::string place = relation.place.text();
    return relateText(relation.rule, relation.target) + (place.empty() ? "" : " (" + place + ")");
}

class Pairs {
public:
    Pairs(const SimplexTree& writers, std::span<const SimplexTree* const> readers, Report& report)
        : report_{report} {
        for (const auto& [path, simplex] : writers.simplexes()) collectWriters(*simplex);
        for (const Pairing& each : writers_) {
            for (std::size_t n = 0; n < each.demanded.size(); ++n)
                written_[each.observed.path(n)].insert(each.demanded.path(n));
        }
        for (const SimplexTree* tree : readers) {
            const std::size_t first = readers_.size();
            for (const auto& [path, simplex] : tree->simplexes()) collectReaders(*simplex);
            for (std::size_t i = first; i < readers_.size(); ++i) enter(i, tree != &writers);
        }
    }

    void check() const {
        for (const Pairing& writer : writers_) check(writer);
    }

private:
    void collectWriters(const Simplex& owner);
    void collectReaders(const Simplex& owner);
    static void add(std::vector<Pairing>& pairings, const Simplex& owner, const Rule& observed,
                    const Rule& demanded);
    void enter(std::size_t reader, bool elsewhere);
    void check(const Pairing& writer) const;
    bool isCrossed(const Crossing& crossing) const;
    void report(const Crossing& crossing) const;
    static std::string remedy(const Crossing& crossing);

    Report& report_;
    std::vector<Pairing> writers_, readers_;
    std::unordered_map<std::string_view, std::vector<std::size_t>> readersOf_;  // of a demand
    // What the one and what the other say that each observation is of.
    using Demands = std::unordered_map<std::string_view, std::set<std::string_view>>;
    Demands written_, read_;
};

void Pairs::collectWriters(const Simplex& owner) {
    for (const Rule& rule : owner.type().rules) {
        const Rule* observed = owner.type().findRule(rule.counterpart);
        if (observed != nullptr) add(writers_, owner, *observed, rule);
    }
}

void Pairs::collectReaders(const Simplex& owner) {
    const Type& type = owner.type();
    std::set<std::string_view> counterparts;
    for (const Rule& rule : type.rules) counterparts.insert(rule.counterpart);
    const auto observes = [&](const Rule& rule) {
        return rule.direction == Direction::Output ? rule.delayed
                                                   : counterparts.contains(rule.name);
    };
    for (const Rule& rule : type.rules) {
        const Rule* other = type.findRule(rule.sameCount);
        if (other == nullptr) continue;
        if (rule.direction == Direction::Input && observes(*other))
            add(readers_, owner, *other, rule);
        else if (other->direction == Direction::Input && observes(rule))
            add(readers_, owner, rule, *other);
    }
}

// Of unequal numbers and what is related twice others tell; one that observes for all belongs to no
// place.
void Pairs::add(std::vector<Pairing>& pairings, const Simplex& owner, const Rule& observed,
                const Rule& demanded) {
    Pairing pairing{&owner, {owner, observed}, {owner, demanded}};
    const auto isOnce = [](const Row& row) { return row.places.size() == row.size(); };
    if (pairing.observed.size() != pairing.demanded.size()) return;
    if (isOnce(pairing.observed) && isOnce(pairing.demanded))
        pairings.push_back(std::move(pairing));
}

// Another agent may have demands of its own at the same paths.
void Pairs::enter(std::size_t reader, bool elsewhere) {
    const Row& demanded = readers_[reader].demanded;
    for (const auto& [path, place] : demanded.places) {
        if (elsewhere && !demanded.relations[place]->remote) continue;
        read_[readers_[reader].observed.path(place)].insert(path);
        auto& all = readersOf_[path];
        if (all.size() < mostReaders) all.push_back(reader);
    }
}

// One finding for each reader: to exchange two lines may mend several places.
void Pairs::check(const Pairing& writer) const {
    std::set<const Simplex*> told;
    for (std::size_t n = 0; n < writer.demanded.size(); ++n) {
        const auto found = readersOf_.find(writer.demanded.path(n));
        if (found == readersOf_.end()) continue;
        for (const std::size_t i : found->second) {
            const Pairing& reader = readers_[i];
            const std::size_t place = reader.demanded.find(writer.demanded.path(n));
            const Crossing crossing{writer, reader, n, place};
            if (!isCrossed(crossing) || !told.insert(reader.owner).second) continue;
            report(crossing);
        }
    }
}

// What observes the demand for the one is another demand's for the other, whoever says so.
bool Pairs::isCrossed(const Crossing& c) const {
    const std::string &ofWriter = c.writer.observed.path(c.written),
                      &ofReader = c.reader.observed.path(c.read);
    if (ofWriter == ofReader) return false;
    const auto isAnothers = [&](const Demands& demands, const std::string& observed) {
        const auto found = demands.find(observed);
        return found != demands.end() && !found->second.contains(c.reader.demanded.path(c.read));
    };
    return isAnothers(read_, ofWriter) || isAnothers(written_, ofReader);
}

void Pairs::report(const Crossing& c) const {
    const Row &written = c.writer.demanded, &read = c.reader.demanded;
    const Simplex::Relation& relation = *written.relations[c.written];
    report_.error(c.writer.owner->path(), finding::pairCrossed, relation.place,
                  relation.target + " (rule '" + relation.rule + "') stands in the place of " +
                      text(c.writer.observed, c.written) + ", but in " + c.reader.owner->path() +
                      " " + text(read, c.read) + " stands in the place of " +
                      text(c.reader.observed, c.read),
                  remedy(c));
}

std::string Pairs::remedy(const Crossing& c) {
    const Row &written = c.writer.demanded, &read = c.reader.demanded;
    const Row &observedByWriter = c.writer.observed, &observedByReader = c.reader.observed;
    // What the reader has in the place of what the writer observes.
    const std::size_t observed = observedByReader.find(observedByWriter.path(c.written));
    const bool readerHasBoth = observed != observedByReader.size();
    std::size_t other = readerHasBoth ? written.find(read.path(observed)) : written.size();
    if (other == written.size()) other = observedByWriter.find(observedByReader.path(c.read));
    const std::string instead = readerHasBoth ? "; if the order in " + c.reader.owner->path() +
                                                    " is wrong, exchange " + line(read, c.read) +
                                                    " and " + line(read, observed)
                                              : "";
    if (other < written.size()) return "exchange this line and " + line(written, other) + instead;
    if (readerHasBoth)
        return "write " + relateText(written.relations[c.written]->rule, read.path(observed)) +
               instead;
    return "write " +
           relateText(observedByWriter.relations[c.written]->rule, observedByReader.path(c.read)) +
           " in the place of " + line(observedByWriter, c.written) + "; if " +
           c.reader.owner->path() + " is wrong, relate another demand or observation there";
}

}  // namespace

void checkCrossedPairs(const SimplexTree& writers, std::span<const SimplexTree* const> readers,
                       Report& report) {
    Pairs{writers, readers, report}.check();
}

}  // namespace cortex
