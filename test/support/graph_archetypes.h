// SPDX-License-Identifier: GPL-3.0-or-later
// Archetypes of CGAL's graphs, of ranges and of property maps: classes that meet their requirements and nothing more,
// like those of archetypes.h for functions.
#ifndef EQUIAFFINE_TEST_SUPPORT_GRAPH_ARCHETYPES_H
#define EQUIAFFINE_TEST_SUPPORT_GRAPH_ARCHETYPES_H

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <compare>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <type_traits>
#include <utility>
#include <vector>

namespace archetypes {

/// A model of CGAL's concept Descriptor, for one kind of elements of a graph.
template <int Kind>
class Descriptor {
public:
  Descriptor() = default;
  explicit Descriptor(std::size_t index) : index_(index) {}
  auto operator<=>(const Descriptor&) const = default;
  std::size_t index() const { return index_; }

private:
  std::size_t index_ = 0;
};
using Vertex = Descriptor<0>;
using Halfedge = Descriptor<1>;
using Face = Descriptor<2>;

/// The end of a range, whose type differs from that of its iterators.
class Sentinel {
public:
  Sentinel() = default;
  explicit Sentinel(std::size_t index) : index_(index) {}
  std::size_t index() const { return index_; }

private:
  std::size_t index_ = 0;
};

/// A forward iterator that returns temporary values.
template <class Value>
class Iterator {
public:
  using value_type = Value;
  using reference = Value;
  using pointer = void;
  using difference_type = std::ptrdiff_t;
  using iterator_category = std::input_iterator_tag;
  using iterator_concept = std::forward_iterator_tag;

  Iterator() = default;
  explicit Iterator(std::size_t index) : index_(index) {}
  Value operator*() const { return Value(index_); }
  Iterator& operator++() {
    ++index_;
    return *this;
  }
  Iterator operator++(int) { return Iterator(index_++); }
  bool operator==(const Iterator&) const = default;
  bool operator==(const Sentinel& end) const { return index_ == end.index(); }

private:
  std::size_t index_ = 0;
};

/// An archetype of CGAL's FaceListGraph, with the part of its interface that is needed for cycles around faces. It has
/// no points. Ranges of its elements are pairs, as in the Boost Graph Library.
class Graph {
public:
  Graph(std::size_t number_of_vertices, std::vector<std::vector<std::size_t>> polygons)
      : number_of_vertices_(number_of_vertices), number_of_faces_(polygons.size()) {
    for (const auto& polygon : polygons) {
      first_.push_back(target_.size());
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        target_.push_back(polygon[k]);
        next_.push_back(first_.back() + (k + 1) % polygon.size());
      }
    }
  }
  Graph(const Graph&) = delete;
  Graph& operator=(const Graph&) = delete;

  friend std::pair<Iterator<Vertex>, Iterator<Vertex>> vertices(const Graph& g) {
    return {Iterator<Vertex>(0), Iterator<Vertex>(g.number_of_vertices_)};
  }
  friend std::pair<Iterator<Face>, Iterator<Face>> faces(const Graph& g) {
    return {Iterator<Face>(0), Iterator<Face>(g.number_of_faces_)};
  }
  friend Halfedge halfedge(Face f, const Graph& g) { return Halfedge(g.first_[f.index()]); }
  friend Halfedge next(Halfedge h, const Graph& g) { return Halfedge(g.next_[h.index()]); }
  friend Vertex target(Halfedge h, const Graph& g) { return Vertex(g.target_[h.index()]); }

private:
  std::size_t number_of_vertices_, number_of_faces_;
  std::vector<std::size_t> first_, target_, next_;
};

/// An archetype of a forward range. Its functions are found by argument-dependent lookup and do not accept constant
/// ranges, and the type of its end differs from that of its beginning.
class Points {
public:
  explicit Points(std::size_t size) : size_(size) {}
  Points(const Points&) = delete;
  Points& operator=(const Points&) = delete;
  friend Iterator<Vertex> begin(Points&) { return Iterator<Vertex>(0); }
  friend Sentinel end(Points& points) { return Sentinel(points.size_); }

private:
  std::size_t size_;
};

/// An archetype of a readable property map that returns the result of a function.
template <class Key, class Function>
class Readable_map {
public:
  using key_type = Key;
  using value_type = std::decay_t<std::invoke_result_t<Function, Key>>;
  using reference = value_type;
  using category = boost::readable_property_map_tag;

  explicit Readable_map(Function function) : function_(std::move(function)) {}
  Readable_map(const Readable_map&) = default;
  Readable_map& operator=(const Readable_map&) = delete;
  friend value_type get(const Readable_map& map, const Key& key) { return map.function_(key); }

private:
  Function function_;
};
template <class Key, class Function>
auto readable_map(Function function) {
  return Readable_map<Key, Function>(std::move(function));
}

/// An archetype of a writable property map that stores values in a map of the caller.
template <class Key, class Value>
class Writable_map {
public:
  using key_type = Key;
  using value_type = Value;
  using reference = void;
  using category = boost::writable_property_map_tag;

  explicit Writable_map(std::map<Key, Value>& values) : values_(&values) {}
  Writable_map(const Writable_map&) = default;
  Writable_map& operator=(const Writable_map&) = delete;
  friend void put(const Writable_map& map, const Key& key, const Value& value) { map.values_->emplace(key, value); }

private:
  std::map<Key, Value>* values_;
};

/// A vector that is constructed from three numbers.
class Vector {
public:
  Vector(double x, double y, double z) : x_(x), y_(y), z_(z) {}
  Vector(const Vector&) = default;
  Vector& operator=(const Vector&) = delete;
  double product_with(double x, double y, double z) const { return x_ * x + y_ * y + z_ * z; }

private:
  double x_, y_, z_;
};

} // namespace archetypes

template <int Kind>
struct std::hash<archetypes::Descriptor<Kind>> {
  std::size_t operator()(const archetypes::Descriptor<Kind>& d) const { return d.index(); }
};

template <>
struct boost::graph_traits<archetypes::Graph> {
  using vertex_descriptor = archetypes::Vertex;
  using halfedge_descriptor = archetypes::Halfedge;
  using face_descriptor = archetypes::Face;
  using vertex_iterator = archetypes::Iterator<archetypes::Vertex>;
  using face_iterator = archetypes::Iterator<archetypes::Face>;
};

#endif
