// SPDX-License-Identifier: Apache-2.0
#include "cortex/core/crossed_pairs.hpp"

#include "cortex/core/system_findings.hpp"

#include "model/remedies.hpp"
#include "model/resolved_relations.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

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

// One of them, by the place of the demand.
struct Said {
    const Pairing& by;
    std::size_t n;

    const std::string& demand() const { return by.demanded.path(n); }
    const std::string& observation() const { return by.observed.path(n); }
};

// Two that say what observes a demand.
struct Crossing {
    Said writer, reader;
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
    return relateText(relation) + (place.empty() ? "" : " (" + place + ")");
}

std::string insteadOf(const Row& row, std::size_t n, const std::string& target) {
    return relateText(*row.relations[n], row.relations[n]->rule, target);
}

class Pairs {
public:
    Pairs(const SimplexTree& writers, std::span<const SimplexTree* const> readers, Report& report)
        : report_{report} {
        for (const auto& [path, simplex] : writers.simplexes()) collectWriters(*simplex);
        for (const Pairing& each : writers_) {
            for (std::size_t n = 0; n < each.demanded.size(); ++n) enter(writing_, {each, n});
        }
        for (const SimplexTree* tree : readers) {
            const std::size_t first = readers_.size();
            for (const auto& [path, simplex] : tree->simplexes()) collectReaders(*simplex);
            for (std::size_t i = first; i < readers_.size(); ++i) enter(i, tree != &writers);
        }
    }

    void check() {
        for (const Pairing& writer : writers_) check(writer);
    }

private:
    void collectWriters(const Simplex& owner);
    void collectReaders(const Simplex& owner);
    static void add(std::vector<Pairing>& pairings, const Simplex& owner, const Rule& observed,
                    const Rule& demanded);
    void enter(std::size_t reader, bool elsewhere);
    void check(const Pairing& writer);
    bool isCrossed(const Crossing& crossing) const;
    void report(const Said& wrong, const Said& other, const std::string& remedy) const;
    static std::string remedyOfEither(const Crossing& crossing);

    // What all of one side say.
    struct Sayings {
        std::unordered_map<std::string_view, std::set<std::string_view>> demands;  // by observation
        // By demand and observation.
        std::map<std::pair<std::string_view, std::string_view>, std::set<const Simplex*>> owners;

        std::size_t count(std::string_view demand, std::string_view observation) const {
            const auto found = owners.find({demand, observation});
            return found == owners.end() ? 0 : found->second.size();
        }
    };
    static void enter(Sayings& sayings, const Said& said);
    std::size_t countOf(std::string_view demand, std::string_view observation) const {
        return writing_.count(demand, observation) + reading_.count(demand, observation);
    }
    std::string demandOf(const Said& wrong) const;
    std::string remedyOfOne(const Said& wrong, const Said& other, const Sayings& side) const;

    Report& report_;
    std::vector<Pairing> writers_, readers_;
    std::unordered_map<std::string_view, std::vector<std::size_t>> readersOf_;  // of a demand
    Sayings writing_, reading_;
    std::set<const Simplex*> odd_;  // readers that are told
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

void Pairs::enter(Sayings& sayings, const Said& said) {
    sayings.demands[said.observation()].insert(said.demand());
    sayings.owners[{said.demand(), said.observation()}].insert(said.by.owner);
}

// Another agent may have demands of its own at the same paths.
void Pairs::enter(std::size_t reader, bool elsewhere) {
    const Row& demanded = readers_[reader].demanded;
    for (const auto& [path, place] : demanded.places) {
        if (elsewhere && !demanded.relations[place]->remote) continue;
        enter(reading_, {readers_[reader], place});
        auto& all = readersOf_[path];
        if (all.size() < mostReaders) all.push_back(reader);
    }
}

// One finding for each reader: to exchange two lines may mend several places. Where more say the
// same as the writer, the reader is wrong, and is told once.
void Pairs::check(const Pairing& writer) {
    std::set<const Simplex*> told;
    for (std::size_t n = 0; n < writer.demanded.size(); ++n) {
        const auto found = readersOf_.find(writer.demanded.path(n));
        if (found == readersOf_.end()) continue;
        for (const std::size_t i : found->second) {
            const Pairing& reader = readers_[i];
            const Crossing each{{writer, n},
                                {reader, reader.demanded.find(writer.demanded.path(n))}};
            if (!isCrossed(each) || !told.insert(reader.owner).second) continue;
            const std::size_t asWriter = countOf(each.writer.demand(), each.writer.observation()),
                              asReader = countOf(each.reader.demand(), each.reader.observation());
            if (asWriter == asReader)
                report(each.writer, each.reader, remedyOfEither(each));
            else if (asWriter < asReader)
                report(each.writer, each.reader, remedyOfOne(each.writer, each.reader, writing_));
            else if (odd_.insert(reader.owner).second)
                report(each.reader, each.writer, remedyOfOne(each.reader, each.writer, reading_));
        }
    }
}

// What observes the demand for the one is another demand's for the other, whoever says so.
bool Pairs::isCrossed(const Crossing& c) const {
    if (c.writer.observation() == c.reader.observation()) return false;
    const auto isAnothers = [&](const Sayings& sayings, const std::string& observation) {
        const auto found = sayings.demands.find(observation);
        return found != sayings.demands.end() && !found->second.contains(c.reader.demand());
    };
    return isAnothers(reading_, c.writer.observation()) ||
           isAnothers(writing_, c.reader.observation());
}

void Pairs::report(const Said& wrong, const Said& other, const std::string& remedy) const {
    const Simplex::Relation& relation = *wrong.by.demanded.relations[wrong.n];
    report_.error(wrong.by.owner->path(), finding::pairCrossed, relation.place,
                  relation.target + " (rule '" + relation.rule + "') stands in the place of " +
                      text(wrong.by.observed, wrong.n) + ", but in " + other.by.owner->path() +
                      " " + text(other.by.demanded, other.n) + " stands in the place of " +
                      text(other.by.observed, other.n),
                  remedy);
}

// Nothing says which of the two is wrong.
std::string Pairs::remedyOfEither(const Crossing& c) {
    const Pairing &writer = c.writer.by, &reader = c.reader.by;
    // What the reader has in the place of what the writer observes.
    const std::size_t observed = reader.observed.find(c.writer.observation());
    const bool readerHasBoth = observed != reader.observed.size();
    std::size_t other = readerHasBoth ? writer.demanded.find(reader.demanded.path(observed))
                                      : writer.demanded.size();
    if (other == writer.demanded.size()) other = writer.observed.find(c.reader.observation());
    const std::string instead =
        readerHasBoth
            ? "; if the order in " + reader.owner->path() + " is wrong, exchange " +
                  line(reader.demanded, c.reader.n) + " and " + line(reader.demanded, observed)
            : "";
    if (other < writer.demanded.size())
        return "exchange this line and " + line(writer.demanded, other) + instead;
    if (readerHasBoth)
        return "write " + insteadOf(writer.demanded, c.writer.n, reader.demanded.path(observed)) +
               instead;
    return "write " + insteadOf(writer.observed, c.writer.n, c.reader.observation()) +
           " in the place of " + line(writer.observed, c.writer.n) + "; if " +
           reader.owner->path() + " is wrong, relate another demand or observation there";
}

// Whose demand others say that its observation is; "": nobody's.
std::string Pairs::demandOf(const Said& wrong) const {
    std::string_view best;
    std::size_t most = 0;
    for (const Sayings* side : {&writing_, &reading_}) {
        const auto found = side->demands.find(wrong.observation());
        if (found == side->demands.end()) continue;
        for (const std::string_view demand : found->second) {
            const std::size_t count = countOf(demand, wrong.observation());
            if (demand == wrong.demand() || count <= most) continue;
            best = demand;
            most = count;
        }
    }
    return std::string{best};
}

// Either its demand or its observation is another simplex: rather the one that fewer of its side
// have already.
std::string Pairs::remedyOfOne(const Said& wrong, const Said& other, const Sayings& side) const {
    const Row &demanded = wrong.by.demanded, &observed = wrong.by.observed;
    const std::string demand = demandOf(wrong);
    const std::size_t place = demanded.find(demand);
    if (place < demanded.size()) return "exchange this line and " + line(demanded, place);
    const std::string observation = "write " + insteadOf(observed, wrong.n, other.observation()) +
                                    " in the place of " + line(observed, wrong.n);
    if (demand.empty()) return observation;
    const std::string instead = "write " + insteadOf(demanded, wrong.n, demand);
    return side.count(demand, wrong.observation()) <=
                   side.count(wrong.demand(), other.observation())
               ? instead + ", or " + observation
               : observation + ", or " + instead + " in the place of this line";
}

}  // namespace

void checkCrossedPairs(const SimplexTree& writers, std::span<const SimplexTree* const> readers,
                       Report& report) {
    Pairs{writers, readers, report}.check();
}

}  // namespace cortex
