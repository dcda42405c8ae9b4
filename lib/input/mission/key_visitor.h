#pragma once

#include <type_traits>
#include <vector>

#include "input/mission/value_types.h"

namespace sonarsim {

/// The base of a visitor of the keys in mission.h. It passes keys with one value to the visitor's
/// method value(key, value, type, meaning, presence).
template <class Visitor>
class KeyVisitor {
  public:
    template <class T>
    void number(const char* key, T& value, const Limits& limits, const char* meaning,
                Presence presence = Presence::optional) {
        self().value(key, value, NumberType{limits, presence == or_auto}, meaning, presence);
    }
    void flag(const char* key, bool& value, const char* meaning) {
        self().value(key, value, FlagType{}, meaning, Presence::optional);
    }
    template <class T>
    void text(const char* key, T& value, const char* meaning,
              Presence presence = Presence::optional) {
        self().value(key, value, TextType{}, meaning, presence);
    }
    template <class T>
    void path(const char* key, T& value, const char* meaning,
              Presence presence = Presence::optional) {
        self().value(key, value, PathType{}, meaning, presence);
    }
    template <class T>
    void array(const char* key, T& values, const Limits& limits, const char* meaning,
               Presence presence = Presence::optional) {
        self().value(key, values, ArrayType{limits}, meaning, presence);
    }
    template <class T>
    void choice(const char* key, T& value, std::type_identity_t<Choices<T>> choices,
                const char* meaning) {
        self().value(key, value, ChoiceType<T>{choices}, meaning, Presence::optional);
    }
    template <class T>
    void subset(const char* key, std::vector<T>& values, std::type_identity_t<Choices<T>> choices,
                const char* meaning) {
        self().value(key, values, SubsetType<T>{choices}, meaning, Presence::optional);
    }
    /// Readers note in `given` whether the mission has a key.
    void note_given(const char* /*key*/, bool& /*given*/) {}

  private:
    Visitor& self() { return static_cast<Visitor&>(*this); }
};

}  // namespace sonarsim
