// Places for texts beside things on a drawing, where they lie on no other text.
#pragma once

#include <optional>
#include <vector>

#include "plot/canvas.h"

namespace stilb::report {

class TextPlaces {
  public:
    /// Texts stay within the frame.
    explicit TextPlaces(const plot::PageRectangle& frame) : frame_(frame) {}

    /// A thing that texts should not cover, but may where there is no other place.
    void avoid(const plot::PageRectangle& thing) { things_.push_back(thing); }

    /// A place for a text of this size beside a thing: below, above, to the right or left of it, as near as
    /// possible. Nothing where other texts, or the frame, leave none.
    std::optional<plot::PageRectangle> place_beside(const plot::PageRectangle& thing, double width,
                                                    double height);
    /// The same in the corners of a thing.
    std::optional<plot::PageRectangle> place_within(const plot::PageRectangle& thing, double width,
                                                    double height);

    const std::vector<plot::PageRectangle>& texts() const { return texts_; }

  private:
    std::optional<plot::PageRectangle> take_first(const std::vector<plot::PageRectangle>& candidates);

    plot::PageRectangle frame_;
    std::vector<plot::PageRectangle> things_, texts_;
};

}  // namespace stilb::report
