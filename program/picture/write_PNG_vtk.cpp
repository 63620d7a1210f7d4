// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/draw_surface.h"

#include <vtkFreeTypeTools.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine {

namespace {

constexpr std::size_t margin = 16, bar_height = 10;

enum class Alignment { LEFT, CENTER, RIGHT };

/// Writes dark text of 13 pixels whose baseline is at row `y`.
void draw_text(Picture& picture, const std::string& text, std::size_t x, std::size_t y, Alignment alignment) {
  vtkNew<vtkTextProperty> style;
  style->SetFontSize(13);
  style->SetColor(0.1, 0.1, 0.1);
  vtkNew<vtkImageData> image;
  std::array<int, 2> size{};
  constexpr int dots_per_inch = 72; // a point is a pixel
  vtkFreeTypeTools::GetInstance()->ScaleToPowerTwoOff();
  if (!vtkFreeTypeTools::GetInstance()->RenderString(style, text, dots_per_inch, image, size.data())) return;
  const int* const extent = image->GetExtent(); // rows from the bottom; the baseline is row 0
  const int left = int(x) - (alignment == Alignment::RIGHT    ? size[0]
                             : alignment == Alignment::CENTER ? size[0] / 2
                                                              : 0);
  for (int row = extent[2]; row <= extent[3]; ++row)
    for (int column = extent[0]; column <= extent[1]; ++column) {
      const int to_x = left + column, to_y = int(y) - row;
      if (to_x < 0 || to_y < 0 || to_x >= int(picture.width) || to_y >= int(picture.height)) continue;
      const auto* const pixel = static_cast<const unsigned char*>(image->GetScalarPointer(column, row, 0));
      unsigned char* const to = &picture.rgb[3 * (std::size_t(to_y) * picture.width + std::size_t(to_x))];
      for (std::size_t n = 0; n < 3; ++n)
        to[n] = static_cast<unsigned char>((pixel[n] * pixel[3] + to[n] * (255 - pixel[3])) / 255);
    }
}

/// Writes a number with enough digits, at least three, to distinguish the numbers on the bar.
std::string short_number(double value, const Color_range& range) {
  const double largest = std::max(std::abs(range.lower), std::abs(range.upper));
  const int digits = std::clamp(int(std::ceil(std::log10(largest / (range.upper - range.lower)))) + 3, 3, 15);
  const bool is_round =
      digits < 5 && std::abs(value) >= 1e3 && std::abs(value) < 1e5; // digits are then no longer than an exponent
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), is_round ? "%.*f" : "%.*g", is_round ? 0 : digits, value);
  return text.data();
}

/// The position of a number on the bar, in [0, 1].
double place_on_bar(double number, const Color_mapping& mapping) {
  const double t = mapping.position(number);
  return mapping.range.is_diverging ? (t + 1) / 2 : t;
}

/// Tick values with their positions: equally spaced on a linear bar; otherwise round numbers, the largest first, at
/// least 1/`most` of the bar apart, or the ends if there are fewer than two of them.
std::vector<std::pair<double, double>> ticks(const Color_mapping& mapping, std::size_t most) {
  const auto& [lower, upper, knee, is_diverging] = mapping.range;
  std::vector<std::pair<double, double>> result;
  if (mapping.scale == Color_scale::LINEAR) {
    for (std::size_t i = 0; i <= most; ++i) {
      const double t = double(i) / double(most);
      const bool is_zero = is_diverging && 2 * i == most; // exactly, without rounding errors
      result.emplace_back(is_zero ? 0 : lower + t * (upper - lower), t);
    }
    return result;
  }
  const auto offer = [&](double number) {
    if (number < lower || number > upper) return;
    const double place = place_on_bar(number, mapping);
    const auto is_near = [&](const auto& other) { return std::abs(other.second - place) < 1. / double(most); };
    if (std::none_of(result.begin(), result.end(), is_near)) result.emplace_back(number, place);
  };
  offer(0);
  constexpr int decades = 12;
  const int largest = int(std::floor(std::log10(std::max(std::abs(lower), std::abs(upper)))));
  for (int power = largest; power > largest - decades; --power)
    for (const double factor : {1., 5., 2.})
      for (const double sign : {1., -1.}) offer(sign * factor * std::pow(10., power));
  if (result.size() < 2) result = {{lower, 0}, {upper, 1}};
  return result;
}

void fill(Picture& picture, std::size_t left, std::size_t top, std::size_t width, std::size_t height,
          const CGAL::IO::Color& color) {
  for (std::size_t row = top; row < top + height; ++row)
    for (std::size_t column = left; column < left + width; ++column) {
      unsigned char* const to = &picture.rgb[3 * (row * picture.width + column)];
      to[0] = color.red();
      to[1] = color.green();
      to[2] = color.blue();
    }
}

/// Writes the note in the row above `bottom`, beside its color if it has one.
void draw_note(Picture& picture, const Color_note& note, std::size_t bottom) {
  if (note.color) fill(picture, margin, bottom - note_height / 2, 2 * bar_height, 2, *note.color);
  const std::size_t left = note.color ? margin + 2 * bar_height + 8 : margin;
  draw_text(picture, note.text, left, bottom - note_height / 2 + 5, Alignment::LEFT);
}

void draw_legend(Picture& picture, const Color_legend& legend) {
  const std::size_t left = margin, width = std::min<std::size_t>(300, picture.width - 2 * margin);
  const std::size_t top = picture.height - margin - 20;
  for (std::size_t i = 0; i < width; ++i) {
    const double t = double(i) / double(width - 1);
    const CGAL::IO::Color color = legend.mapping.range.is_diverging ? diverging_color(2 * t - 1) : sequential_color(t);
    fill(picture, left + i, top, 1, bar_height, color);
  }
  draw_text(picture, legend.label, left, top - 7, Alignment::LEFT);
  const auto text = [&](double number) { return short_number(number, legend.mapping.range); };
  const auto touch = [&](const std::vector<std::pair<double, double>>& labels) { // with 8 pixels for a character
    std::size_t longest = 0;
    for (const auto& [number, place] : labels) longest = std::max(longest, text(number).size());
    return legend.mapping.scale == Color_scale::LINEAR && 8 * longest * labels.size() > width;
  };
  auto labels = ticks(legend.mapping, 4);
  if (touch(labels)) labels = ticks(legend.mapping, 2);
  for (const auto& [number, place] : labels) {
    const auto x = std::size_t(std::lround(place * double(width - 1)));
    fill(picture, left + x, top + bar_height, 1, 3, CGAL::IO::Color(26, 26, 26));
    draw_text(picture, text(number), left + x, top + bar_height + 15,
              place < 0.1   ? Alignment::LEFT
              : place > 0.9 ? Alignment::RIGHT
                            : Alignment::CENTER);
  }
}

} // namespace

void write_PNG(std::ostream& stream, Surface_picture surface) {
  Picture& picture = surface.picture;
  if (surface.legend) draw_legend(picture, *surface.legend);
  const std::size_t bottom = picture.height - (surface.legend ? legend_height : note_margin);
  for (std::size_t i = 0; i < surface.notes.size(); ++i) draw_note(picture, surface.notes[i], bottom - i * note_height);
  vtkNew<vtkImageData> image;
  image->SetDimensions(int(picture.width), int(picture.height), 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (std::size_t row = 0; row < picture.height; ++row) // VTK's rows go up
    std::copy_n(&picture.rgb[3 * row * picture.width], 3 * picture.width,
                static_cast<unsigned char*>(image->GetScalarPointer(0, int(picture.height - 1 - row), 0)));
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray& bytes = *writer->GetResult();
  stream.write(reinterpret_cast<const char*>(bytes.GetPointer(0)), std::streamsize(bytes.GetNumberOfValues()));
}

} // namespace equiaffine
