def test_tell_the_error_over_all_frames_and_the_worst_one(markdown, sample):
    sample["scenes"][0]["fits"] = [
        {"body": "cloth", "rms": [0.003, 0.0, 0.004, 0.0], "max": [0.006, 0, 0.01, 0]},
        {"body": "box", "rms": [0.0], "max": [0.0]}]
    text = markdown(sample)
    assert "| body | RMS | max | in frame |" in text
    assert "| cloth | 2.50 | 10.0 | 2 |" in text
    assert "| box | 0 | 0 | 0 |" in text


def test_are_in_the_report_of_scenes_that_have_them_alone(markdown, sample):
    assert "fitted" not in markdown(sample)
    sample["scenes"][0]["fits"] = [{"body": "cloth", "rms": [0.001], "max": [0.002]}]
    assert "| cloth | 1.00 | 2.00 | 0 |" in markdown(sample)
