"""Operations on a series that only measures of chaos need: delay vectors, sections, sampling, tones, distances."""
